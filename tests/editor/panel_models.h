/* panel_models.h - models of the window's parts as a session might have them, for pictures and tests. */
#ifndef BATTEN_PANEL_MODELS_H
#define BATTEN_PANEL_MODELS_H

#include "panel.h"

extern const struct top_model model_top, model_top_none;
extern const struct menu_model model_menu, model_menu_long, model_menu_error, model_menu_main,
        model_menu_jobs;
extern const struct Mouse_Words model_mouse, model_mouse_both, model_mouse_few;
extern const struct foot_model model_foot, model_foot_choose, model_foot_error;

#endif
