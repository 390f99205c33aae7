/* quantity.c - the seven curvatures: titles, symbols, channels. */
#include "world.h"

const struct quantity_row quantity_table[N_QUANTITIES] = {
	[QUANTITY_K] = { "Gaussian curvature", "K", "K", true, 2 },
	[QUANTITY_H] = { "Mean curvature", "H", "H", true, 1 },
	[QUANTITY_KABS] = { "Absolute curvature", "|k1| + |k2|", "kabs", false, 1 },
	[QUANTITY_KMAX] = { "Maximum principal curvature", "k max", "kmax", true, 1 },
	[QUANTITY_KMIN] = { "Minimum principal curvature", "k min", "kmin", true, 1 },
	[QUANTITY_KN_U] = { "Normal curvature along u", "kn u", "kn_u", true, 1 },
	[QUANTITY_KN_V] = { "Normal curvature along v", "kn v", "kn_v", true, 1 },
};
