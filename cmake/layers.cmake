# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT

# The layers of src, from the bottom. A directory may use directories of lower layers. If a layer is one whole directory
# of src, its directories may also use each other. The methods in library/ must not use each other.
set(flagstone_layers
    "library/core"
    "library/plane_fits"
    "library/(patchwork|surface|mount|ground_map)"
    "library/moving_points"
    "library/methods"
    "library/c_api"
    "files"
    "lab"
    "app"
    "cli")

# Sets `result` to the index of the layer of `path`, a path from src.
function(flagstone_layer path result)
  set(index 0)
  foreach(layer IN LISTS flagstone_layers)
    if(path MATCHES "^(${layer})(/|$)")
      set(${result} ${index} PARENT_SCOPE)
      return()
    endif()
    math(EXPR index "${index} + 1")
  endforeach()
  message(FATAL_ERROR "src/${path} is in no layer (expected one of ${flagstone_layers}; see cmake/layers.cmake)")
endfunction()

# Fails unless the directory `from` may use the directory `to`; both are paths from src. `how` describes the use.
function(flagstone_check_dependency from to how)
  flagstone_layer(${from} upper)
  flagstone_layer(${to} lower)
  list(GET flagstone_layers ${upper} layer)
  if(lower GREATER upper OR (lower EQUAL upper AND layer MATCHES "[|]" AND NOT from STREQUAL to))
    message(FATAL_ERROR "src/${from} must not use src/${to}: ${how} (expected only layers below; see cmake/layers.cmake)")
  endif()
endfunction()

# Checks the libraries that every flagstone_* target links, and that there is no cyclic dependency.
function(flagstone_check_layers)
  set_property(GLOBAL PROPERTY GLOBAL_DEPENDS_NO_CYCLES ON)
  get_property(targets GLOBAL PROPERTY FLAGSTONE_LIBRARIES)
  foreach(target IN LISTS targets)
    get_target_property(from ${target} FLAGSTONE_FOLDER)
    get_target_property(linked ${target} LINK_LIBRARIES)
    foreach(library IN LISTS linked)
      if(library IN_LIST targets)
        get_target_property(to ${library} FLAGSTONE_FOLDER)
        flagstone_check_dependency(${from} ${to} "${target} links ${library}")
      endif()
    endforeach()
  endforeach()
endfunction()

# As a script, cmake -P cmake/layers.cmake: checks the includes of every file in src.
if(CMAKE_SCRIPT_MODE_FILE STREQUAL CMAKE_CURRENT_LIST_FILE)
  cmake_path(GET CMAKE_CURRENT_LIST_DIR PARENT_PATH root)
  file(GLOB_RECURSE files RELATIVE ${root}/src ${root}/src/*.hpp ${root}/src/*.cpp)
  foreach(file IN LISTS files)
    cmake_path(GET file PARENT_PATH from)
    file(STRINGS ${root}/src/${file} includes REGEX "^#include \"(library|files|lab|app|cli)/")
    foreach(include IN LISTS includes)
      string(REGEX REPLACE "^#include \"([^\"]+)/[^/\"]+\".*" "\\1" to "${include}")
      flagstone_check_dependency(${from} ${to} "${file} has ${include}")
    endforeach()
  endforeach()
  list(LENGTH files count)
  message("${count} files use only layers below their own")
endif()
