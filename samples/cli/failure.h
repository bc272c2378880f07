// How the program ends early: a Failure holds the one sentence that stderr gets.
#pragma once

#include "common/failure.h"

namespace alpenglow::cli {

using samples::check;
using samples::Failure;
using samples::take;
using samples::writeText;

}  // namespace alpenglow::cli
