/* level_look.c - blocks of traced patches, looked into before they are joined. */
#include "level_look.h"

#include <stdlib.h>
#include <string.h>

#include "level_private.h"

#define HEAD_MAGIC "levelof"

struct head_bytes {
	char magic[8];
	int kind, unused;
	double value;
};

void level_head_add(struct text *out, const struct level_head *head)
{
	const struct head_bytes bytes = { .magic = HEAD_MAGIC,
		                          .kind = head->kind,
		                          .value = head->value };
	text_add_bytes(out, &bytes, sizeof bytes);
}

static bool head_read(const char *block, size_t n, struct head_bytes *out)
{
	if (n < sizeof *out)
		return false;
	memcpy(out, block, sizeof *out);
	return !memcmp(out->magic, HEAD_MAGIC, sizeof out->magic) && out->kind >= 0 &&
	       out->kind < N_LEVEL_KINDS;
}

size_t level_head_size(const char *block, size_t n)
{
	struct head_bytes head;
	return head_read(block, n, &head) ? sizeof head : 0;
}

static void point_put(struct curve *c, int i, const double p[3], const double dp[3], double share)
{
	double *out = c->points + 4 * (size_t)i;
	for (int d = 0; d < 3; d++)
		out[d] = p[d] + share * dp[d];
	out[3] = 1;
}

/* The pieces as Bezier spans of one parameter length. */
static enum status strand_curve(struct curve *c, const char *pieces, int n)
{
	enum status st = curve_init(c, 4, 3 * n + 1);
	for (int i = 0; i < n && st == ST_OK; i++) {
		struct piece x;
		memcpy(&x, pieces + (size_t)i * sizeof x, sizeof x);
		if (!i)
			point_put(c, 0, x.p[0], x.dp[0], 0);
		point_put(c, 3 * i + 1, x.p[0], x.dp[0], 1 / 3.0);
		point_put(c, 3 * i + 2, x.p[1], x.dp[1], -1 / 3.0);
		point_put(c, 3 * i + 3, x.p[1], x.dp[1], 0);
	}
	for (int k = 0; k < 3 * n + 5 && st == ST_OK; k++)
		c->knots[k] = k < 4 ? 0 : k > 3 * n ? n : (k - 1) / 3;
	c->domain[1] = n;
	return st;
}

static enum status take_patch(const struct patch_header *h, const char *strands,
                              const struct level_head *head, level_take *take, void *data)
{
	const char *pieces = strands + (size_t)h->n_strands * sizeof(struct strand);
	enum status st = ST_OK;
	for (int k = 0; k < h->n_strands && st == ST_OK; k++) {
		struct strand s;
		struct curve c = { 0 };
		memcpy(&s, strands + (size_t)k * sizeof s, sizeof s);
		if (!level_strand_valid(&s, h))
			break;
		st = strand_curve(&c, pieces + (size_t)s.first * sizeof(struct piece), s.n);
		if (st == ST_OK)
			st = take(data, head, &c);
		curve_finish(&c);
	}
	return st;
}

enum status level_look(const char *block, size_t n, level_take *take, void *data)
{
	struct head_bytes bytes;
	struct patch_header h;
	enum status st = ST_OK;
	if (!head_read(block, n, &bytes))
		return ST_OK;
	const struct level_head head = { (enum level_kind)bytes.kind, bytes.value };
	const char *at = block + sizeof bytes, *end = block + n;
	for (int last = -1;
	     at < end && st == ST_OK && level_header_read(SIZE_MAX, &at, end, last, &h);
	     last = h.patch) {
		st = take_patch(&h, at, &head, take, data);
		at += (size_t)h.n_strands * sizeof(struct strand) +
		      (size_t)h.n_pieces * sizeof(struct piece) +
		      (size_t)h.n_undecided * sizeof(struct undecided) +
		      (size_t)h.n_umbilics * sizeof(struct umbilic);
	}
	return st;
}
