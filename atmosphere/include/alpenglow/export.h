// Marks the functions of the library.
#pragma once

#ifndef ALPENGLOW_API
#define ALPENGLOW_API
#endif
