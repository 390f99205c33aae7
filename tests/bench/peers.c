/* peers.c - the peers that are installed. */
#include <stddef.h>

#include "peer.h"

const struct peer *const peers[] = {
#ifdef HAVE_SISL
	&peer_sisl,
#endif
#ifdef HAVE_OCCT
	&peer_occt,
#endif
	NULL, /* ends the list */
};
