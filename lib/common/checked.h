/* checked.h - is this a build that checks addresses? It reserves more memory than there is, so that no limit
 * could hold it. */
#ifndef BATTEN_CHECKED_H
#define BATTEN_CHECKED_H

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define CHECKED_BUILD 1
#endif
#endif
#if defined(__SANITIZE_ADDRESS__)
#define CHECKED_BUILD 1
#endif
#ifndef CHECKED_BUILD
#define CHECKED_BUILD 0
#endif

#endif
