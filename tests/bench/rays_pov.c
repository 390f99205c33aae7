/* rays_pov.c - the same view by POV-Ray. */
#include "rays_pov.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bezier.h"

enum { STEPS_LOG2 = 5 }; /* 32 x 32 */

static void put_vector(FILE *f, struct vec3 p)
{
	fprintf(f, "<%.9g,%.9g,%.9g>", p.x, p.y, p.z);
}

static bool put_surface(FILE *f, const struct surface *s)
{
	struct bezier_net net;
	if (s->rational || s->order[0] != 4 || s->order[1] != 4 ||
	    bezier_net_init(&net, s) != ST_OK)
		return false;
	for (int a = 0; a < net.spans[0]; a++)
		for (int b = 0; b < net.spans[1]; b++) {
			const double *p = bezier_patch(&net, a, b);
			fprintf(f, "bicubic_patch{type 1 flatness 0 u_steps %d v_steps %d",
			        STEPS_LOG2, STEPS_LOG2);
			for (int k = 0; k < 16; k++) {
				fputs(", ", f);
				put_vector(f, vec3(p[4 * k], p[4 * k + 1], p[4 * k + 2]));
			}
			fputs("}\n", f);
		}
	bezier_net_finish(&net);
	return true;
}

static bool put_scene(FILE *f, const struct surface *const *surfaces, int n,
                      const struct pov_view *v)
{
	bool ok = true;
	fputs("#version 3.7;\nglobal_settings{assumed_gamma 1}\ncamera{location ", f);
	put_vector(f, v->eye);
	fputs(" direction ", f);
	put_vector(f, v->ahead);
	fputs(" right ", f);
	put_vector(f, v->right);
	fputs(" up ", f);
	put_vector(f, v->up);
	fputs("}\nlight_source{", f);
	put_vector(f, vec3_scale(v->light, 1000 * vec3_length(v->eye)));
	fputs(" rgb 1 parallel point_at 0}\nunion{\n", f);
	for (int i = 0; i < n && ok; i++)
		ok = put_surface(f, surfaces[i]);
	fputs("texture{pigment{rgb 1} finish{ambient .1 diffuse .9}}}\n", f);
	return ok;
}

static double run_seconds(const char *pov, const char *scene, const char *picture, int size)
{
	char in[80], out[80], width[32], height[32];
	int status;
	struct rusage used;
	snprintf(in, sizeof in, "+I%s", scene);
	snprintf(out, sizeof out, "+O%s", picture);
	snprintf(width, sizeof width, "+W%d", size);
	snprintf(height, sizeof height, "+H%d", size);
	const pid_t pid = fork();
	if (pid == 0) {
		const int silent = open("/dev/null", O_WRONLY);
		dup2(silent, STDOUT_FILENO);
		dup2(silent, STDERR_FILENO);
		execl(pov, pov, in, out, width, height, "-D", "+WT1", "-A", "-V", (char *)NULL);
		_exit(127);
	}
	if (pid < 0 || wait4(pid, &status, 0, &used) != pid || status != 0)
		return -1;
	return (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
	       1e-6 * (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

double pov_seconds(const char *pov, const struct surface *const *surfaces, int n,
                   const struct pov_view *v)
{
	char folder[] = "/tmp/batten-bench-XXXXXX", scene[64], picture[64];
	double out = -1;
	if (!mkdtemp(folder))
		return out;
	snprintf(scene, sizeof scene, "%s/scene.pov", folder);
	snprintf(picture, sizeof picture, "%s/scene.png", folder);
	FILE *f = fopen(scene, "w");
	if (f) {
		bool ok = put_scene(f, surfaces, n, v);
		ok = fclose(f) == 0 && ok;
		if (ok)
			out = run_seconds(pov, scene, picture, v->size);
	}
	unlink(scene);
	unlink(picture);
	rmdir(folder);
	return out;
}
