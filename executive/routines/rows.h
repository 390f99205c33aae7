/* rows.h - the arguments of the leaves, and the leaves' functions; private to routines. */
#ifndef BATTEN_ROWS_H
#define BATTEN_ROWS_H

#include "routine.h"

/* rows.c, by what is asked for; a list ends with name NULL. */
extern const struct argument_row rows_background[], rows_bell[], rows_close[], rows_color[],
        rows_curve[], rows_curve_edit[], rows_curve_insert[], rows_curve_split[],
        rows_cylinder_count[], rows_cylinder_distance[], rows_cylinder_start[],
        rows_cylinder_tolerance[], rows_cylinder_tolerance_uv[], rows_elevate[], rows_elevate_d[],
        rows_entities_file[], rows_export[], rows_fit[], rows_grid_map[], rows_grid_shade[],
        rows_insert_d[], rows_isophotes[], rows_jobs[], rows_light[], rows_lines[],
        rows_lines_file[], rows_linetype[], rows_map[], rows_map_file[], rows_material[],
        rows_mirror[], rows_move[], rows_on[], rows_open[], rows_perspective[], rows_split_view[],
        rows_image_on[], rows_picture[], rows_plane_count[], rows_plane_distance[],
        rows_plane_start[], rows_plane_tolerance[], rows_plane_tolerance_uv[], rows_porcupine[],
        rows_quit[], rows_recall[], rows_reflection[], rows_rename[], rows_rotate[], rows_ruled[],
        rows_samples[], rows_save_as[], rows_scale[], rows_segments[], rows_shade_file[],
        rows_split_d[], rows_surface[], rows_surface_edit[], rows_surface_resolution[],
        rows_trace_file[], rows_view[];

/* A setting that only stores defaults of later jobs, as its rows say. */
routine_run setting_store;

/* files.c, input.c */
routine_run files_open, files_save, files_save_as, files_export, files_picture, files_rename,
        files_close, files_undo, files_redo;
routine_run input_recall, input_iges;
/* curves_show.c, surface_show.c; detail: an enum entity_kind */
routine_run show_segments, show_color, show_line_type, show_view, show_samples, show_porcupine,
        show_on, show_off;
routine_run surface_resolution, surface_on, image_on, surface_light, surface_image,
        surface_map_file, surface_lines_file;
/* surface_jobs.c; detail of surface_quantity: an enum quantity */
routine_run job_image, job_curvature, job_lines, surface_quantity, surface_show_lines;
/* contours.c; detail: 0 planes, 1 cylinders */
routine_run job_contours, contours_show;
/* edit.c, transform.c */
routine_run edit_point, edit_elevate, edit_insert, edit_split, edit_fit, edit_ruled;
routine_run transform_mirror, transform_move, transform_rotate, transform_scale;
/* world_menu.c; detail of jobs_each: an enum message_type */
routine_run world_background, world_choose, world_list_jobs, world_jobs, world_perspective,
        world_split, world_bell, world_quit;

#endif
