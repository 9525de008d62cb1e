// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

/// The files of the WebAssembly module, which has no file system. memory_files.cpp implements
/// io::load_bytes() and io::write_file() on them, so that all readers and writers work unchanged.
namespace flagstone::web {

/// Adds a file of `size` bytes, or replaces it, and returns its bytes to fill. May throw
/// std::bad_alloc.
std::span<std::byte> add_file(const std::string& name, std::size_t size);

/// Removes all files.
void remove_files() noexcept;

/// The bytes of the file written last. Valid until the next file is written.
std::span<const std::byte> written_file() noexcept;

}  // namespace flagstone::web
