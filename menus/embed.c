/* embed.c - run by the build: the menu files as bytes in a C file, in the order of MENU_ROOTS. */
#include <stdio.h>

static int put_file(const char *path, int number)
{
	FILE *f = fopen(path, "rb");
	int c, n = 0;

	if (!f) {
		perror(path);
		return 1;
	}
	printf("static const char menu_%d[] = {", number);
	while ((c = getc(f)) != EOF)
		printf("%s%d,", n++ % 24 ? " " : "\n\t", c < 128 ? c : c - 256);
	printf("\n};\n");
	if (ferror(f) || fclose(f)) {
		perror(path);
		return 1;
	}
	return 0;
}

int main(int argc, char **argv)
{
	printf("#include \"entry.h\"\n");
	for (int k = 1; k < argc; k++)
		if (put_file(argv[k], k))
			return 1;
	printf("const struct built_in built_in_menus[N_MENUS] = {\n");
	for (int k = 1; k < argc; k++)
		printf("\t{ menu_%d, sizeof menu_%d },\n", k, k);
	printf("};\n");
	return fflush(stdout) ? 1 : 0;
}
