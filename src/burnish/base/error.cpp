#include "burnish/base/error.h"

namespace burnish {

std::string_view to_string(ErrorCode code) {
  switch (code) {
    case ErrorCode::invalid_argument:
      return "invalid_argument";
    case ErrorCode::not_found:
      return "not_found";
    case ErrorCode::bad_file:
      return "bad_file";
    case ErrorCode::unsupported:
      return "unsupported";
    case ErrorCode::bad_geometry:
      return "bad_geometry";
    case ErrorCode::io_failure:
      return "io_failure";
    case ErrorCode::out_of_memory:
      return "out_of_memory";
    case ErrorCode::refuted:
      return "refuted";
    case ErrorCode::cancelled:
      return "cancelled";
  }
  return "unknown";
}

}  // namespace burnish
