#pragma once

/// ACS_API marks what a library defines for its users: all that a shared library exports. Both kinds of libraries
/// have the same headers. To keep a static library hidden in a shared one of your own, compile with -DACS_API= and link with
/// -Wl,--exclude-libs,ALL. ACS_HIDDEN marks a class inside an exported one that only the library uses.
#ifndef ACS_API
#ifdef __GNUC__
#define ACS_API __attribute__((visibility("default")))
#else
#define ACS_API
#endif
#endif
#ifdef __GNUC__
#define ACS_HIDDEN __attribute__((visibility("hidden")))
#else
#define ACS_HIDDEN
#endif
