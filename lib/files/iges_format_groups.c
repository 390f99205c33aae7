/* iges_format_groups.c - groups for the IGES writer: 402 form 7 with their names. */
#include "iges_writer.h"

#include <stdlib.h>
#include <string.h>

void iges_join_group(struct iges_writer *w, const struct entity *e, int de)
{
	const char *group = entity_get_attribute(e, "group");
	if (!group || !group[0])
		return;
	if ((w->n_members & (w->n_members - 1)) == 0) {
		void *p = reallocarray(w->members, w->n_members ? (size_t)w->n_members * 2 : 1,
		                       sizeof *w->members);
		if (!p) {
			w->data.failed = true;
			return;
		}
		w->members = p;
	}
	w->members[w->n_members++] = (struct iges_member){ group, de };
}

static int by_group(const void *a, const void *b)
{
	const struct iges_member *x = a, *y = b;
	int order = strcmp(x->group, y->group);
	return order ? order : (x->de > y->de) - (x->de < y->de);
}

void iges_put_groups(struct iges_writer *w)
{
	struct iges_member *m = w->members;
	if (w->n_members)
		qsort(m, (size_t)w->n_members, sizeof *m, by_group);
	for (int i = 0, n; i < w->n_members; i += n) {
		for (n = 1; i + n < w->n_members && strcmp(m[i].group, m[i + n].group) == 0; n++)
			;
		int name = iges_put_name(w, m[i].group);
		iges_begin(w, 402);
		iges_put_int(w, n, ',');
		for (int k = 0; k < n; k++)
			iges_put_int(w, m[i + k].de, ',');
		iges_end_form(w, 402, 7, 0, name, "00000300");
	}
}
