// The mark of functions that hosts call.
#pragma once

#ifndef ALPENGLOW_API
#define ALPENGLOW_API
#endif
