// Everything of the core library, Alpenglow::atmosphere.
#pragma once

#include <alpenglow/camera.h>
#include <alpenglow/context.h>
#include <alpenglow/mesh.h>
#include <alpenglow/parameters.h>
#include <alpenglow/query.h>
#include <alpenglow/tables.h>
#include <alpenglow/terrain.h>
#include <alpenglow/types.h>
#include <alpenglow/version.h>
#include <alpenglow/view.h>
