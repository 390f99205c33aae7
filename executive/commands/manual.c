/* manual.c - --help, man pages and the completion, made from the verbs' rows. */
#include <stdlib.h>
#include <string.h>

#include "command.h"

static const char purpose[] = "an executive for modelling with rational B-splines";

static void print_options(const struct option_row *rows, FILE *out)
{
	for (; rows && rows->name; rows++) {
		char left[64];
		snprintf(left, sizeof left, "%s%s%s%s%s", rows->letter ? rows->letter : "",
		         rows->letter ? ", " : "", rows->name, rows->value ? " " : "",
		         rows->value ? rows->value : "");
		fprintf(out, "  %-22s %s\n", left, rows->help);
	}
}

void command_help(const struct command *c, FILE *out)
{
	fprintf(out, "usage: batten %s%s%s\n\n%s.\n", c->name, *c->usage ? " " : "", c->usage,
	        c->text);
	if (c->help && *c->help)
		fprintf(out, "\n%s\n", c->help);
	fputs("\noptions:\n", out);
	print_options(c->options, out);
	print_options(option_common, out);
}

void program_help(FILE *out)
{
	fprintf(out, "batten %s - %s\n\nusage: batten VERB ...\n\n", BATTEN_VERSION, purpose);
	for (int i = 0; command_table[i]; i++)
		fprintf(out, "  %-10s %s\n", command_table[i]->name, command_table[i]->text);
	fputs("\nbatten VERB --help tells more; batten help lists topics.\n", out);
}

/* Text into roff: a leading point or quote, and backslashes and minus signs, are not to be orders. */
static void print_roff(const char *s, FILE *out)
{
	for (bool start = true; *s; start = *s == '\n', s++) {
		if (start && (*s == '.' || *s == '\''))
			fputs("\\&", out);
		if (*s == '\\')
			fputs("\\e", out);
		else if (*s == '-')
			fputs("\\-", out);
		else if (*s == '\n' && s[1] == '\n') {
			fputs("\n.PP", out);
		} else
			fputc(*s, out);
	}
	fputc('\n', out);
}

static void man_options(const struct option_row *rows, FILE *out)
{
	for (; rows && rows->name; rows++) {
		fputs(".TP\n.B ", out);
		if (rows->letter) {
			print_roff(rows->letter, out);
			fputs(".br\n.B ", out);
		}
		char left[64];
		snprintf(left, sizeof left, "%s%s%s", rows->name, rows->value ? " " : "",
		         rows->value ? rows->value : "");
		print_roff(left, out);
		print_roff(rows->help, out);
	}
}

static void man_program(FILE *out)
{
	fprintf(out, ".TH BATTEN 1 \"\" \"batten %s\" \"Batten\"\n.SH NAME\nbatten \\- %s\n",
	        BATTEN_VERSION, purpose);
	fputs(".SH SYNOPSIS\n.B batten\n.I verb\n[arguments]\n.SH DESCRIPTION\n", out);
	fputs("Long computations on NURBS curves and surfaces run as jobs: worker processes that a\n"
	      "service of the project folder launches, watches, suspends, activates and kills.\n"
	      ".SH VERBS\n",
	      out);
	for (int i = 0; command_table[i]; i++) {
		fprintf(out, ".TP\n.BR batten\\-%s (1)\n", command_table[i]->name);
		print_roff(command_table[i]->text, out);
	}
	fputs(".SH EXIT STATUS\n0 success; 1 failure; 2 usage or parameter; 130 interrupted or killed.\n"
	      ".SH FILES\n.TP\n.I .batten/\nthe project's ledger, inputs, part files, job files and "
	      "logs\n.TP\n.I ~/.config/batten/config\nsettings; see\n.BR batten\\-config (1)\n",
	      out);
}

void command_man(const struct command *c, FILE *out)
{
	if (!c) {
		man_program(out);
		return;
	}
	fprintf(out, ".TH BATTEN-%s 1 \"\" \"batten %s\" \"Batten\"\n.SH NAME\nbatten-%s \\- ",
	        c->name, BATTEN_VERSION, c->name);
	print_roff(c->text, out);
	fprintf(out, ".SH SYNOPSIS\n.B batten %s\n", c->name);
	print_roff(c->usage, out);
	if (c->help && *c->help) {
		fputs(".SH DESCRIPTION\n", out);
		print_roff(c->help, out);
	}
	fputs(".SH OPTIONS\n", out);
	man_options(c->options, out);
	man_options(option_common, out);
	fputs(".SH SEE ALSO\n.BR batten (1)\n", out);
}

/* ------------------------------------------------------------ completion */

static void completion_options(const struct option_row *rows, FILE *out)
{
	for (; rows && rows->name; rows++)
		fprintf(out, " %s", rows->name);
}

static const char *completion_words(enum word_kind kind)
{
	static const char *const rows[] = {
		[WORD_NONE] = "",
		[WORD_FILE] = "_filedir",
		[WORD_JOB] = "words=$(batten jobs --all --json 2>/dev/null |"
		             " sed -n 's/^{\"id\":\\([0-9]*\\),.*/\\1/p')",
		[WORD_WORKER] = "words=$(batten workers --json 2>/dev/null |"
		                " sed -n 's/^      \"name\": \"\\([a-z]*\\)\",$/\\1/p')",
		[WORD_TOPIC] = "words=$(batten help --json 2>/dev/null |"
		               " sed -n 's/^ *\"topic\": \"\\(.*\\)\",$/\\1/p')",
	};

	return rows[kind];
}

void program_completion(FILE *out)
{
	fputs("# bash completion for batten, made from its table of verbs\n"
	      "_batten()\n{\n"
	      "\tlocal cur=${COMP_WORDS[COMP_CWORD]} verb=${COMP_WORDS[1]} words= options=\n"
	      "\tif ((COMP_CWORD == 1)); then\n\t\twords='",
	      out);
	for (int i = 0; command_table[i]; i++)
		fprintf(out, "%s%s", i ? " " : "", command_table[i]->name);
	fputs("'\n\telse\n\t\tcase $verb in\n", out);
	for (int i = 0; command_table[i]; i++) {
		const struct command *c = command_table[i];
		fprintf(out, "\t\t%s)\n\t\t\toptions='", c->name);
		completion_options(c->options, out);
		completion_options(option_common, out);
		fputs("'\n", out);
		if (c->first_word != c->words)
			fprintf(out,
			        "\t\t\tif ((COMP_CWORD == 2)); then\n\t\t\t\t%s\n\t\t\telse\n\t\t\t\t%s\n"
			        "\t\t\tfi\n",
			        c->first_word ? completion_words(c->first_word) : ":",
			        c->words ? completion_words(c->words) : ":");
		else if (c->words)
			fprintf(out, "\t\t\t%s\n", completion_words(c->words));
		fputs("\t\t\t;;\n", out);
	}
	fputs("\t\tesac\n\t\t[[ $cur == -* ]] && words=$options\n\tfi\n"
	      "\t[[ $words ]] && COMPREPLY=($(compgen -W \"$words\" -- \"$cur\"))\n"
	      "\treturn 0\n}\n"
	      "type _filedir >/dev/null 2>&1 ||\n"
	      "\t_filedir() { COMPREPLY=($(compgen -f -- \"${COMP_WORDS[COMP_CWORD]}\")); }\n"
	      "complete -F _batten batten\n",
	      out);
}
