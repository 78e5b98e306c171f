#include "burnish/io/output.h"

namespace burnish {

void Output::flush() {
  if (ok() && !buffer_.empty()) error_ = writer_.write(buffer_);
  buffer_.clear();
}

bool Output::advance(std::size_t rows) {
  done_ += rows;
  if (context_.cancelled()) fail(cancelled());
  if (buffer_.size() >= kFull / 2) flush();
  if (ok() && rows_ > 0) {
    context_.progress(done_ < rows_ ? static_cast<double>(done_) / static_cast<double>(rows_)
                                    : 1.0);
  }
  return ok();
}

Result<void> Output::finish() {
  flush();
  return error_;
}

}  // namespace burnish
