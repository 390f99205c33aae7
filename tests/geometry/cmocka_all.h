/* cmocka_all.h - cmocka with the headers it wants before it. */
#ifndef BATTEN_TEST_CMOCKA_ALL_H
#define BATTEN_TEST_CMOCKA_ALL_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#endif
