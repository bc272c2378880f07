// Everything of the core library, Alpenglow::atmosphere.
#pragma once

#include <alpenglow/camera.h>
#include <alpenglow/context.h>
#include <alpenglow/effects.h>
#include <alpenglow/parameters.h>
#include <alpenglow/plan.h>
#include <alpenglow/query.h>
#include <alpenglow/table_limits.h>
#include <alpenglow/tables.h>
#include <alpenglow/types.h>
#include <alpenglow/version.h>
#include <alpenglow/view.h>
