// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>
#include <rapidcheck.h>

#include <algorithm>
#include <string>
#include <vector>

#include "files/io/bytes.hpp"
#include "files/io/cloud.hpp"

namespace flagstone::io {

inline const std::vector all_field_types{
    FieldType::int8,   FieldType::uint8, FieldType::int16,  FieldType::uint16,  FieldType::int32,
    FieldType::uint32, FieldType::int64, FieldType::uint64, FieldType::float32, FieldType::float64};

/// Fields of random types, counts and order: x, y and z and up to six more, some of them padding.
inline rc::Gen<std::vector<Field>> arbitrary_fields() {
  return rc::gen::exec([] {
    std::vector<Field> fields{{"x"}, {"y"}, {"z"}};
    const auto extra = *rc::gen::inRange<std::size_t>(0, 7);
    for (std::size_t i = 0; i < extra; ++i) {
      const bool is_padding = *rc::gen::weightedElement<bool>({{1, true}, {3, false}});
      const auto name = is_padding ? std::string(padding_name) : fmt::format("f{}", i);
      fields.push_back({name, FieldType::uint8, *rc::gen::inRange<std::size_t>(1, 5)});
    }
    for (Field& field : fields) field.type = *rc::gen::elementOf(all_field_types);
    for (std::size_t i = fields.size(); i > 1; --i) {
      std::swap(fields[i - 1], fields[*rc::gen::inRange<std::size_t>(0, i)]);
    }
    return fields;
  });
}

/// Up to 40 points with such fields and random bytes, including NaN and infinity.
inline rc::Gen<Cloud> arbitrary_cloud() {
  return rc::gen::exec([] {
    const auto fields = *arbitrary_fields();
    std::size_t stride = 0;
    for (const Field& field : fields) stride += field.size();
    const auto points = *rc::gen::inRange<std::size_t>(0, 41);
    const auto values = *rc::gen::container<std::vector<std::uint8_t>>(
        points * stride, rc::gen::arbitrary<std::uint8_t>());
    Cloud cloud;
    const auto bytes = std::as_bytes(std::span(values));
    RC_ASSERT(Cloud::from_rows(fields, {bytes.begin(), bytes.end()}, cloud).ok());
    return cloud;
  });
}

}  // namespace flagstone::io

namespace rc {

/// How rapidcheck prints a cloud of a failed property.
inline void showValue(const flagstone::io::Cloud& cloud, std::ostream& out) {
  out << cloud.size() << " points of";
  for (const auto& field : cloud.fields()) {
    out << ' ' << field.name << ':' << to_string(field.type) << 'x' << field.count;
  }
}

}  // namespace rc
