#pragma once

namespace burnish {

/// The build reads the version from here too: this is the one place where it stands.
inline constexpr const char* kVersion = "0.1.0";

}  // namespace burnish
