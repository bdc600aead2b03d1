#include "server/collision/object_io.hpp"

#include <array>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/collision/samples.hpp"
#include "server/collision/superquadric_object.hpp"
#include "tests/support/fields.hpp"

namespace mechane::collision {
namespace {

const std::vector<std::byte>& good_file() {
  static const std::vector<std::byte> bytes = [] {
    geometry::Superquadric shape;
    shape.a = {0.01, 0.02, 0.03};
    return write_object(make_superquadric_object(shape, 0.01));
  }();
  return bytes;
}

const std::vector<std::byte>& field_file() {
  static const std::vector<std::byte> bytes = [] {
    Object object = mechane::test::object_of(mechane::test::ball_field());
    append_samples(object, 0, {Vec3(0.01, 0, 0), Vec3(0, 0.02, 0.01)});
    close_clusters(object);
    return write_object(object);
  }();
  return bytes;
}

RC_GTEST_PROP(ObjectIo, ATruncatedFileIsAnError, ()) {
  const auto size = *rc::gen::inRange<std::size_t>(0, good_file().size());
  RC_ASSERT(!read_object(std::span(good_file()).first(size)));
}

RC_GTEST_PROP(ObjectIo, AFlippedBitIsAnError, ()) {
  std::vector<std::byte> bytes = good_file();
  const auto at = *rc::gen::inRange<std::size_t>(0, bytes.size());
  bytes[at] ^= std::byte{static_cast<unsigned char>(1U << *rc::gen::inRange(0, 8))};
  RC_ASSERT(!read_object(bytes));
}

/// With a right checksum over wrong bytes: an Error, or an object that can be asked.
RC_GTEST_PROP(ObjectIo, WhatPassesTheChecksumIsSoundOrAnError, ()) {
  std::vector<std::byte> bytes = *rc::gen::arbitrary<bool>() ? good_file() : field_file();
  const bool near_start = *rc::gen::arbitrary<bool>();  // most of a file is values that may be any
  const int changes = *rc::gen::inRange(1, 6);
  for (int i = 0; i < changes; ++i) {
    const auto at = *rc::gen::inRange<std::size_t>(12, near_start ? 320 : bytes.size() - 8);
    bytes[at] = std::byte{*rc::gen::arbitrary<unsigned char>()};
  }
  reseal(bytes);
  const auto object = read_object(bytes);
  if (!object) {
    RC_ASSERT(object.error().code == ErrorCode::damaged);
    return;
  }
  std::array<PointContact, 16> storage;
  ContactBuffer buffer(storage);
  find_contacts(*object, {}, *object, {{0.001, 0, 0}, Quat::Identity()}, buffer);
}

}  // namespace
}  // namespace mechane::collision
