// Numbers as bytes, little-endian, and back within bounds. What journals, snapshot files and recorded frames are written with.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "server/base/assert.hpp"

namespace mechane {

/// Appends to a vector.
class VectorSink {
 public:
  explicit VectorSink(std::vector<std::byte>& out) : out_(out) {}
  /// Not inlined: else g++ 12 warns, wrongly, of a copy past the end.
  [[gnu::noinline]] void append(const std::byte* data, std::size_t size) { out_.insert(out_.end(), data, data + size); }

 private:
  std::vector<std::byte>& out_;
};

/// Appends to a string of bytes.
class StringSink {
 public:
  explicit StringSink(std::string& out) : out_(out) {}
  void append(const std::byte* data, std::size_t size) { out_.append(reinterpret_cast<const char*>(data), size); }

 private:
  std::string& out_;
};

/// Fills a span. The caller makes it large enough; writing past its end is our own bug.
class SpanSink {
 public:
  explicit SpanSink(std::span<std::byte> out) : out_(out) {}
  void append(const std::byte* data, std::size_t size) noexcept {
    MECHANE_ASSERT(size <= out_.size() - used_);
    std::memcpy(out_.data() + used_, data, size);
    used_ += size;
  }
  [[nodiscard]] std::size_t used() const noexcept { return used_; }

 private:
  std::span<std::byte> out_;
  std::size_t used_ = 0;
};

template <class T, class Sink>
requires std::is_unsigned_v<T>
void put(Sink& sink, T value) {
  std::byte bytes[sizeof(T)];
  for (std::size_t i = 0; i < sizeof(T); ++i)
    bytes[i] = static_cast<std::byte>(value >> (8 * i));
  sink.append(bytes, sizeof(T));
}

/// LEB128: 7 bits a byte, the lowest first.
template <class Sink>
void put_varint(Sink& sink, std::uint64_t value) {
  std::byte bytes[10];
  std::size_t n = 0;
  for (; value >= 0x80; value >>= 7)
    bytes[n++] = static_cast<std::byte>(value | 0x80);
  bytes[n++] = static_cast<std::byte>(value);
  sink.append(bytes, n);
}

/// Small numbers of either sign in few bytes.
template <class Sink>
void put_signed(Sink& sink, std::int64_t value) {
  put_varint(sink, (static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63));
}

template <class Sink>
void put_bytes(Sink& sink, std::span<const std::byte> bytes) {
  put_varint(sink, bytes.size());
  if (!bytes.empty()) sink.append(bytes.data(), bytes.size());
}

template <class Sink>
void put_string(Sink& sink, std::string_view text) {
  put_bytes(sink, std::as_bytes(std::span(text.data(), text.size())));
}

/// Reads what the functions above wrote. After a read past the end, or a malformed number, ok() stays false and all further reads
/// give zeros.
class ByteSource {
 public:
  explicit ByteSource(std::span<const std::byte> in) : in_(in) {}

  [[nodiscard]] bool ok() const noexcept { return ok_; }
  [[nodiscard]] std::size_t remaining() const noexcept { return ok_ ? in_.size() - at_ : 0; }
  void fail() noexcept { ok_ = false; }

  template <class T>
  requires std::is_unsigned_v<T>
  [[nodiscard]] T get() noexcept {
    if (remaining() < sizeof(T)) fail();
    if (!ok_) return 0;
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i)
      value |= std::to_integer<std::uint64_t>(in_[at_ + i]) << (8 * i);
    at_ += sizeof(T);
    return static_cast<T>(value);
  }
  [[nodiscard]] std::uint64_t get_varint() noexcept {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      const auto byte = get<std::uint8_t>();
      if (shift == 63 && byte > 1) fail();
      value |= static_cast<std::uint64_t>(byte & 0x7f) << shift;
      if ((byte & 0x80) == 0) return ok_ ? value : 0;
    }
    fail();
    return 0;
  }
  [[nodiscard]] std::int64_t get_signed() noexcept {
    const std::uint64_t value = get_varint();
    return static_cast<std::int64_t>((value >> 1) ^ (~(value & 1) + 1));
  }
  [[nodiscard]] std::span<const std::byte> get_bytes() noexcept {
    const std::uint64_t size = get_varint();
    if (size > remaining()) fail();
    if (!ok_) return {};
    at_ += size;
    return in_.subspan(at_ - size, size);
  }
  [[nodiscard]] std::string get_string() {
    const auto bytes = get_bytes();
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }

 private:
  std::span<const std::byte> in_;
  std::size_t at_ = 0;
  bool ok_ = true;
};

}  // namespace mechane
