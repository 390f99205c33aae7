/* panel_models.h - models of the window's parts as a session might have them, for pictures and tests. */
#ifndef BATTEN_PANEL_MODELS_H
#define BATTEN_PANEL_MODELS_H

#include "panel.h"

extern const struct top_model model_top, model_top_none;
extern const struct menu_model model_menu, model_menu_long, model_menu_error, model_menu_main,
        model_menu_jobs;
extern const struct Mouse_Words model_mouse, model_mouse_both, model_mouse_few;
extern const struct foot_model model_foot, model_foot_choose, model_foot_error, model_foot_kill;
extern const struct probe_model model_probe;
extern const struct key_model model_key, model_key_none;
extern const struct jobs_model model_jobs, model_jobs_none;
extern const struct search_model model_search, model_search_none;
extern const struct help_model model_help;
extern const struct keys_model model_keys;
extern const struct color_model model_color;
extern const struct light_model model_light;
extern const struct bar_model model_bar, model_bar_long;
extern const struct empty_model model_empty;
extern const struct list_model model_list, model_question;

#endif
