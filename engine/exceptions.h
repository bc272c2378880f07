// ALPENGLOW_TRY { ... } ALPENGLOW_CATCH_BAD_ALLOC { ... }: try and catch, or the first block alone
// where the core is compiled without exceptions; an allocation that fails ends the process there.
#pragma once

#include <new>

#ifdef __cpp_exceptions
#define ALPENGLOW_TRY try
#define ALPENGLOW_CATCH_BAD_ALLOC catch (const std::bad_alloc&)
#else
#define ALPENGLOW_TRY if constexpr (true)
#define ALPENGLOW_CATCH_BAD_ALLOC else
#endif
