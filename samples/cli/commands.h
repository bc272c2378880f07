// The commands. Each throws a Failure when it can't do what was asked.
#pragma once

#include "arguments.h"

namespace alpenglow::cli {

/// Lists the presets, or prints one as JSON when `name` isn't empty.
void runPresets(const std::string& name);
void runBake(const BakeArguments& arguments);
void runRender(const RenderArguments& arguments);
void runExplain(const ExplainArguments& arguments);
/// What runRender does where --flythrough was given.
void runFlythrough(const RenderArguments& arguments);
void runProbe(const ProbeArguments& arguments);
/// Where the program was built with Alpenglow::cost.
void runCost(const CostArguments& arguments);

}  // namespace alpenglow::cli
