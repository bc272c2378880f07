// The commands. Each throws a Failure when it can't do what was asked.
#pragma once

#include "arguments.h"

namespace alpenglow::cli {

/// Lists the presets, or prints one as JSON when `name` isn't empty.
void runPresets(const std::string& name);
void runBake(const BakeArguments& arguments);
void runRender(const RenderArguments& arguments);
void runProbe(const ProbeArguments& arguments);

/// Checks, before any work, that the output and the report can be written and differ.
void checkOutputs(const RunArguments& arguments);

}  // namespace alpenglow::cli
