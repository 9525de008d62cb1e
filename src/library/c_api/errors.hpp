// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <exception>
#include <new>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "flagstone/flagstone.h"

/// Errors of the C++ API as return values. No exception leaves a function of flagstone.h.
namespace flagstone::c_api {

/// Writes the message, unless `error` is null, and returns `status`. Control characters become
/// spaces, so that a name from the caller cannot break the line.
flagstone_status report(flagstone_error* error, flagstone_status status,
                        std::string_view message) noexcept;

/// Runs `action`, and reports the exception that it throws.
template <class Action>
flagstone_status guarded(flagstone_error* error, Action&& action) noexcept {
  try {
    std::forward<Action>(action)();
  } catch (const std::bad_alloc&) {
    return report(error, FLAGSTONE_OUT_OF_MEMORY, "not enough memory");
  } catch (const std::invalid_argument& invalid) {
    return report(error, FLAGSTONE_INVALID_ARGUMENT, invalid.what());
  } catch (const std::exception& other) {
    return report(error, FLAGSTONE_INTERNAL_ERROR, other.what());
  } catch (...) {
    return report(error, FLAGSTONE_INTERNAL_ERROR, "unknown error");
  }
  return report(error, FLAGSTONE_OK, "");
}

/// Throws std::invalid_argument "NAME: is NULL (expected EXPECTED)" if `pointer` is null.
void require(const void* pointer, std::string_view name, std::string_view expected);

/// Throws std::invalid_argument if `index` is not less than `count`.
void require_index(std::size_t index, std::size_t count);

/// Stores in `*handle` what `make` returns, or null if it throws, and reports the error.
template <class Handle, class Make>
flagstone_status create(Handle** handle, flagstone_error* error, Make&& make) noexcept {
  if (handle != nullptr) *handle = nullptr;
  return guarded(error, [&] {
    require(static_cast<const void*>(handle), "handle", "the address of a pointer");
    *handle = std::forward<Make>(make)().release();
  });
}

}  // namespace flagstone::c_api
