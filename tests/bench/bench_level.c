/* bench_level.c - curves on a surface with known answers: speed, how many are found, how far they are from the exact
 * ones, beside the peers that are installed and a mesh, in turn with them in one run. CPU time, medians, one thread. */
#include <stdio.h>
#include <stdlib.h>

#include "../geometry/level_shapes.h"
#include "bench.h"
#include "bench_curves.h"
#include "bench_march.h"
#include "peer.h"

enum { ROUNDS = 5, SIDES = 4 };

/* Pieces were counted elsewhere by changes of sign on a grid. */
static const struct row {
	const char *row, *what;
	struct level_field field; /* of the first value */
	enum peer_field_kind theirs;
	int many; /* values that are `step` apart */
	double step, tolerance;
	double target; /* ms */
	int known;
} rows[] = {
/* clang-format off */
	{ "10", "50 planes, 1e-6",
	  { .kind = LEVEL_PLANE, .direction = { 0, 0, 1 }, .value = -0.784 }, PEER_PLANE,
	  .many = 50, .step = 0.032, .tolerance = 1e-6, .target = 30, .known = 900 },
	{ "11", "50 planes, 1e-4",
	  { .kind = LEVEL_PLANE, .direction = { 0, 0, 1 }, .value = -0.784 }, PEER_PLANE,
	  .many = 50, .step = 0.032, .tolerance = 1e-4, .target = 18, .known = 900 },
	{ "12", "10 cylinders, 1e-6",
	  { .kind = LEVEL_CYLINDER, .direction = { 1, 0, 0 }, .point = { 0, 5, 0 }, .value = 0.3 },
	  PEER_CYLINDER,
	  .many = 10, .step = 0.45, .tolerance = 1e-6, .target = 6, .known = 20 },
	{ "14", "silhouette, 1e-6",
	  { .kind = LEVEL_SILHOUETTE, .direction = { 0.8, 0.36, 0.48 } }, PEER_SILHOUETTE,
	  .many = 1, .tolerance = 1e-6, .target = 4, .known = 12 },
	{ "14", "silhouette from an eye, 1e-6",
	  { .kind = LEVEL_EYE, .direction = { 0, 0, 1 }, .eye = { 30, 18, 14 } }, PEER_EYE,
	  .many = 1, .tolerance = 1e-6, .target = 7, .known = 9 },
	{ "15", "isophote 35 degrees, 1e-6",
	  { .kind = LEVEL_ISOPHOTE, .direction = { 0, 0, 1 }, .value = 0.81915204428899178 },
	  PEER_ISOPHOTE, .many = 1, .tolerance = 1e-6, .target = 10, .known = 85 },
	{ "15", "isophote 50 degrees, 1e-6",
	  { .kind = LEVEL_ISOPHOTE, .direction = { 0, 0, 1 }, .value = 0.64278760968653933 },
	  PEER_ISOPHOTE, .many = 1, .tolerance = 1e-6, .target = 15, .known = 84 },
/* clang-format on */
};

static struct level_field field_of(const struct row *row, int k)
{
	struct level_field field = row->field;
	field.value += k * row->step;
	return field;
}

/* One way to the curves of a row: ours, a peer's, or a mesh. */
struct job {
	const struct row *row;
	const struct surface *s;
	const struct peer *peer; /* NULL: ours, or the mesh */
	void *theirs;
	bool mesh;
	struct off *off; /* not NULL: places of the curves are checked */
	/* ours, of the last run: */
	size_t closed, undecided, pieces;
	double length, max_error;
};

static void result_check(const struct level_result *x, struct off *off)
{
	for (size_t b = 0; b < x->n_branches; b++) {
		const struct curve *c = &x->branches[b].space;
		for (int i = 0; i < PEER_PLACES; i++) {
			const double t = (i + 0.5) / PEER_PLACES;
			const struct vec3 p =
			        curve_point(c, c->domain[0] + t * (c->domain[1] - c->domain[0]));
			off_add((double[3]){ p.x, p.y, p.z }, off);
		}
	}
}

/* From the surface on; what is prepared for the first value serves all. */
static int run_ours(struct job *j)
{
	const struct row *row = j->row;
	struct level *first = NULL;
	struct level_field field = field_of(row, 0);
	int found = 0;
	enum status st = level_create(&first, j->s, &field, row->tolerance, NULL);
	j->closed = j->undecided = j->pieces = 0;
	j->length = j->max_error = 0;
	for (int k = 0; st == ST_OK && k < row->many; k++) {
		struct level_result x = { 0 };
		struct level *l = NULL;
		field = field_of(row, k);
		st = level_create_like(&l, first, field.value, NULL);
		if (st == ST_OK)
			st = shape_trace_level(l, &x, NULL);
		found += (int)x.n_branches;
		j->closed += x.n_closed;
		j->undecided += x.n_undecided;
		j->length += x.length;
		j->max_error = fmax(j->max_error, x.max_error);
		for (size_t i = 0; i < x.n_branches; i++)
			j->pieces += x.branches[i].uv.n / 3;
		if (j->off) {
			j->off->field = &field;
			result_check(&x, j->off);
		}
		level_result_finish(&x);
		level_destroy(l);
	}
	level_destroy(first);
	if (st != ST_OK)
		bench_fail("curves could not be traced");
	return found;
}

static int run_peer(struct job *j)
{
	const struct row *row = j->row;
	const struct vec3 d = row->field.direction;
	const struct vec3 p = row->theirs == PEER_EYE ? row->field.eye : row->field.point;
	struct peer_field f = { .kind = row->theirs,
		                .direction = { d.x, d.y, d.z },
		                .point = { p.x, p.y, p.z },
		                .tolerance = row->tolerance };
	int found = 0;
	for (int k = 0; k < row->many; k++) {
		const struct level_field field = field_of(row, k);
		f.value = field.value;
		if (j->off)
			j->off->field = &field;
		found += j->peer->curves(j->theirs, &f, j->off ? off_add : NULL, j->off);
	}
	return found;
}

static int run_mesh(struct job *j)
{
	const struct row *row = j->row;
	struct level_field field = field_of(row, 0);
	struct march *m = march_create(j->s, &field);
	int found = 0;
	for (int k = 0; k < row->many; k++) {
		field = field_of(row, k);
		if (j->off)
			j->off->field = &field;
		found += march_curves(m, field.value, j->off ? off_add : NULL, j->off);
	}
	march_destroy(m);
	return found;
}

static double run(void *data)
{
	struct job *j = data;
	return j->mesh ? run_mesh(j) : j->peer ? run_peer(j) : run_ours(j);
}

/* False where a count or an error of ours is wrong. */
static bool row_run(const struct row *row, const struct surface *s, void *const *theirs)
{
	struct job jobs[SIDES] = { { .row = row, .s = s } };
	struct bench_side sides[SIDES] = { { .name = "batten", .run = run, .data = &jobs[0] } };
	int n = 1;
	for (; peers[n - 1]; n++) {
		jobs[n] = (struct job){
			.row = row, .s = s, .peer = peers[n - 1], .theirs = theirs[n - 1]
		};
		sides[n] = (struct bench_side){ .name = peers[n - 1]->name,
			                        .run = run,
			                        .data = &jobs[n] };
	}
	jobs[n] = (struct job){ .row = row, .s = s, .mesh = true };
	sides[n] = (struct bench_side){ .name = "a mesh", .run = run, .data = &jobs[n] };
	n++;
	bench_alternate(sides, n, ROUNDS);

	char what[3][80];
	static const char *const names[3] = { "%s", "%s: true error", "%s: curves found" };
	for (int k = 0; k < 3; k++)
		snprintf(what[k], sizeof what[k], names[k], row->what);
	struct bench_row time = { row->row,    what[0], "ms",     1e3 * sides[0].cpu,
		                  row->target, true,    { { 0 } } };
	struct bench_row error = { row->row, what[1], "", 0, row->tolerance, true, { { 0 } } };
	struct bench_row count = { row->row,   what[2], "",       sides[0].check,
		                   row->known, false,   { { 0 } } };
	struct off off[SIDES];
	for (int k = 0; k < n; k++) {
		off[k] = (struct off){ .s = s };
		jobs[k].off = &off[k];
		run(&jobs[k]);
		if (k == 0) {
			error.ours = off[k].most;
		} else if (sides[k].check > 0) {
			error.peer[k - 1] = (struct bench_peer){ sides[k].name, off[k].most };
			count.peer[k - 1] = (struct bench_peer){ sides[k].name, sides[k].check };
			if (!jobs[k].mesh)
				time.peer[k - 1] =
				        (struct bench_peer){ sides[k].name, 1e3 * sides[k].cpu };
		}
	}
	bench_print(&time);
	bench_print(&error);
	bench_print(&count);
	printf("%s (%d known):\n  batten: %g curves, %zu closed, %zu undecided, %zu pieces, length %.9g, stated error %.2g\n",
	       row->what, row->known, sides[0].check, jobs[0].closed, jobs[0].undecided,
	       jobs[0].pieces, jobs[0].length, jobs[0].max_error);
	for (int k = 1; k < n; k++)
		if (sides[k].check > 0)
			printf("  %s: %g curves, %.3g ms, error %.2g%s%s\n", sides[k].name,
			       sides[k].check, 1e3 * sides[k].cpu, off[k].most,
			       off[k].most > row->tolerance ? ", misses the tolerance" : "",
			       off[k].lost > 0 ? ", partly far from any exact curve" : "");
	return sides[0].check == row->known && jobs[0].undecided == 0 && off[0].lost == 0 &&
	       off[0].most <= jobs[0].max_error + 1e-9 && jobs[0].max_error <= row->tolerance;
}

int main(void)
{
	struct surface s;
	void *theirs[SIDES] = { 0 };
	if (shape_make(&s, 4, 30, shape_wavy) != ST_OK)
		return 1;
	const struct peer_net net = { .order = { s.order[0], s.order[1] },
		                      .n = { s.n[0], s.n[1] },
		                      .knots = { s.knots[0], s.knots[1] },
		                      .points = s.points };
	for (int k = 0; peers[k]; k++)
		theirs[k] = peers[k]->surface(&net);
	bool right = true;
	for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
		right &= row_run(&rows[i], &s, theirs);
	for (int k = 0; peers[k]; k++)
		peers[k]->drop(theirs[k]);
	surface_finish(&s);
	return right ? 0 : 1;
}
