#pragma once

#include <string>
#include <string_view>

namespace burnish {

/// Why something could not be done. The program's exit statuses follow from it
/// (docs/exit-status.md).
enum class ErrorCode {
  invalid_argument,  ///< a parameter, option or combination of inputs that cannot be
  not_found,         ///< a file or folder that does not exist
  bad_file,          ///< a file that is damaged or not what its format asks for
  unsupported,       ///< a sound file or request that burnish cannot handle
  bad_geometry,      ///< a mesh, cloud or frame that the operation cannot work on
  io_failure,        ///< the operating system refused to read or write
  out_of_memory,
  refuted,  ///< what was to be verified does not hold
  cancelled,
};

/// The name of a code in snake_case, as the program and Python show it.
std::string_view to_string(ErrorCode code);

/// What was expected, what came, and the place.
struct Error {
  ErrorCode code = ErrorCode::invalid_argument;
  std::string message;  ///< one sentence without a full stop: "vertex has 2 numbers, 3 expected"
  std::string where;    ///< the place, possibly empty: "scan.ply, line 12"

  /// "scan.ply, line 12: vertex has 2 numbers, 3 expected"
  std::string text() const { return where.empty() ? message : where + ": " + message; }
};

inline Error cancelled() {
  return {ErrorCode::cancelled, "cancelled", {}};
}

}  // namespace burnish
