#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "burnish/pipeline/registered_frames.h"

namespace burnish::app {

/// What the user said of how poses are to be found, as typed.
struct RegistrationTexts {
  std::string angle, nearest, farthest;
  bool turntable = false, sequence = false, open = false;
};

/// Adds --turntable, --sequence, --angle, --open, --nearest and --farthest to a verb.
void add_registration_options(CLI::App* verb, RegistrationTexts& texts);

/// Errors: invalid_argument.
Result<FrameRegistration> read_registration_texts(const RegistrationTexts& texts);

}  // namespace burnish::app
