#include "registration_options.h"

#include "burnish/base/quantity.h"

namespace burnish::app {

void add_registration_options(CLI::App* verb, RegistrationTexts& texts) {
  auto* table = verb->add_flag("--turntable", texts.turntable,
                               "an object turned before a camera that stands still");
  verb->add_flag("--sequence", texts.sequence,
                 "a camera carried along, frame after frame; the default")
      ->excludes(table);
  verb->add_option("--angle", texts.angle,
                   "of the table from frame to frame, about; default: a full turn by the number of "
                   "frames");
  verb->add_flag("--open", texts.open, "the table did not come round to the first frame again");
  verb->add_option("--nearest", texts.nearest, "depths below are not looked at");
  verb->add_option("--farthest", texts.farthest,
                   "depths beyond are not looked at: what stands behind a turntable");
}

Result<FrameRegistration> read_registration_texts(const RegistrationTexts& texts) {
  FrameRegistration registration;
  const auto read = [](const std::string& text, Quantity quantity, const char* option,
                       double& value) -> Result<void> {
    if (text.empty()) return {};
    const Result<double> number = parse_quantity(text, quantity);
    if (!number) return Error{number.error().code, number.error().message, option};
    value = *number;
    return {};
  };
  for (const auto& done :
       {read(texts.angle, Quantity::angle, "--angle", registration.turntable.step),
        read(texts.nearest, Quantity::length, "--nearest", registration.nearest),
        read(texts.farthest, Quantity::length, "--farthest", registration.farthest)}) {
    if (!done) return done.error();
  }
  if (!texts.turntable && (!texts.angle.empty() || texts.open)) {
    return Error{ErrorCode::invalid_argument, "belongs to --turntable",
                 texts.open ? "--open" : "--angle"};
  }
  if (texts.turntable) registration.scene = FrameRegistration::Scene::turntable;
  registration.turntable.closed = !texts.open;
  return registration;
}

}  // namespace burnish::app
