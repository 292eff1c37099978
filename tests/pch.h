// What nearly every test includes, compiled once: the library's headers, and GoogleTest.
#ifndef kedge_tests_pch_h
#define kedge_tests_pch_h

#include <kedge/pch.h>

#include <gtest/gtest.h>

#endif
