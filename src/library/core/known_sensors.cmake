# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT

# cmake -D files="a.toml;b.toml" -D source=OUT.cpp -P known_sensors.cmake
#
# Makes a C++ initialiser of each file: `key = value` becomes `.key = value,`, so keys stand in the order of the struct
# Sensor. Files use no more of TOML than comment lines, numbers, strings and arrays of numbers; a test reads
# them with a real parser too and compares.
set(sensors "")
foreach(file IN LISTS files)
  file(READ ${file} text)
  string(REGEX REPLACE "(^|\n)#[^\n]*" "\\1" text "${text}")
  string(REPLACE "[" "{" text "${text}")
  string(REPLACE "]" "}" text "${text}")
  string(REGEX REPLACE "([a-z_]+) = ({[^}]*}|[^\n]+)" ".\\1 = \\2," text "${text}")
  string(APPEND sensors "Sensor{${text}},\n")
endforeach()
file(WRITE ${source} "#include \"library/core/known_sensors.hpp\"\n\nnamespace flagstone {\n\n\
std::vector<Sensor> make_known_sensors() {\n  return {\n${sensors}  };\n}\n\n}  // namespace flagstone\n")
