#pragma once

#include <cassert>
#include <optional>
#include <utility>
#include <variant>

#include "burnish/base/error.h"

namespace burnish {

/// A value or an Error, with the member names of std::expected. Both convert to it implicitly:
///   Result<int> half(int n) { if (n % 2) return Error{...}; return n / 2; }
template <class T>
class [[nodiscard]] Result {
 public:
  using value_type = T;
  using error_type = Error;

  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

  bool has_value() const { return state_.index() == 0; }
  explicit operator bool() const { return has_value(); }

  T& value() & { return get(); }
  const T& value() const& { return get(); }
  T&& value() && { return std::move(get()); }
  T& operator*() & { return get(); }
  const T& operator*() const& { return get(); }
  T&& operator*() && { return std::move(get()); }
  T* operator->() { return &get(); }
  const T* operator->() const { return &get(); }
  template <class U>
  T value_or(U&& other) const& {
    return has_value() ? get() : static_cast<T>(std::forward<U>(other));
  }

  Error& error() & { return failure(); }
  const Error& error() const& { return failure(); }
  Error&& error() && { return std::move(failure()); }

 private:
  T& get() { return assert(has_value()), *std::get_if<0>(&state_); }
  const T& get() const { return assert(has_value()), *std::get_if<0>(&state_); }
  Error& failure() { return assert(!has_value()), *std::get_if<1>(&state_); }
  const Error& failure() const { return assert(!has_value()), *std::get_if<1>(&state_); }

  std::variant<T, Error> state_;
};

/// Success or an Error: `return {};` is success.
template <>
class [[nodiscard]] Result<void> {
 public:
  using value_type = void;
  using error_type = Error;

  Result() = default;
  Result(Error error) : error_(std::move(error)) {}

  bool has_value() const { return !error_; }
  explicit operator bool() const { return has_value(); }
  void value() const { assert(has_value()); }

  Error& error() & { return assert(error_), *error_; }
  const Error& error() const& { return assert(error_), *error_; }
  Error&& error() && { return assert(error_), std::move(*error_); }

 private:
  std::optional<Error> error_;
};

}  // namespace burnish
