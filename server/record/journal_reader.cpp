#include "server/record/journal_reader.hpp"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <xxhash.h>

#include "server/base/byte_order.hpp"
#include "server/record/tick_codec.hpp"

namespace mechane::record {
namespace {

using journal_format::FrameKind;
using journal_format::kFrameHeadSize;

// Reads `size` bytes in pieces: a false length takes no more memory than the file has bytes.
bool read_exactly(std::istream& in, std::size_t size, std::vector<std::byte>& out) {
  constexpr std::size_t kPiece = 1u << 20;
  out.clear();
  while (out.size() < size) {
    const std::size_t at = out.size();
    const std::size_t piece = std::min(kPiece, size - at);
    out.resize(at + piece);
    in.read(reinterpret_cast<char*>(out.data() + at), static_cast<std::streamsize>(piece));
    const auto got = static_cast<std::size_t>(in.gcount());
    if (got < piece) {
      out.resize(at + got);
      return false;
    }
  }
  return true;
}

}  // namespace

struct JournalReader::Frame {
  FrameKind kind = FrameKind::close;
  std::vector<std::byte> payload;
};

JournalReader::JournalReader(std::unique_ptr<std::istream> in) : in_(std::move(in)) {}
JournalReader::JournalReader(JournalReader&&) noexcept = default;
JournalReader& JournalReader::operator=(JournalReader&&) noexcept = default;
JournalReader::~JournalReader() = default;

Expected<JournalReader> JournalReader::open_file(const std::filesystem::path& path) {
  auto file = std::make_unique<std::ifstream>(path, std::ios::binary);
  if (!*file) return fail(ErrorCode::not_found, "cannot be read", path.string(), "name an existing .journal file");
  JournalReader reader(std::move(file));
  if (auto read = reader.read_header(path.string()); !read) return tl::unexpected(read.error());
  return reader;
}

Expected<JournalReader> JournalReader::open_bytes(std::span<const std::byte> bytes, const std::string& name) {
  JournalReader reader(std::make_unique<std::istringstream>(
      std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()), std::ios::binary));
  if (auto read = reader.read_header(name); !read) return tl::unexpected(read.error());
  return reader;
}

Expected<void> JournalReader::read_header(const std::string& name) {
  std::vector<std::byte> preamble;
  const bool complete = read_exactly(*in_, journal_format::kPreambleSize, preamble);
  if (!complete || std::memcmp(preamble.data(), journal_format::kMagic, sizeof journal_format::kMagic) != 0) {
    return fail(ErrorCode::damaged, "is not a journal", name, "name a .journal file that a Mechane server wrote");
  }
  ByteSource version_bytes(std::span<const std::byte>(preamble).subspan(sizeof journal_format::kMagic));
  const auto version = version_bytes.get<std::uint32_t>();
  header_.state_version = static_cast<state::StateVersion>(version);
  if (!state::is_known(header_.state_version)) {
    return fail(ErrorCode::wrong_version,
                fmt::format("is a journal of version {}; this program reads those up to {}", version,
                            static_cast<std::uint32_t>(state::kStateVersion)),
                name, "use the release that wrote it");
  }
  good_offset_ = journal_format::kPreambleSize;
  Frame frame;
  const bool read = read_frame(frame) && frame.kind == FrameKind::header;
  ByteSource in(frame.payload);
  for (std::string* text :
       {&header_.world_id, &header_.kiosk, &header_.scenario_id, &header_.scenario_hash, &header_.build_id}) {
    *text = in.get_string();
  }
  header_.start_wall_ns = in.get<std::uint64_t>();
  header_.first_tick = in.get<std::uint64_t>();
  const auto snapshot = in.get_bytes();
  header_.snapshot.assign(snapshot.begin(), snapshot.end());
  if (!read || !in.ok() || in.remaining() != 0) {
    return fail(ErrorCode::damaged, "the journal's header is cut off or damaged", name,
                "nothing in this file can be recovered; use another journal");
  }
  good_offset_ += kFrameHeadSize + frame.payload.size();
  next_tick_ = header_.first_tick;
  frame_end_ = header_.first_tick;
  return {};
}

bool JournalReader::stop(JournalEnd::Kind kind, std::string message) {
  ended_ = true;
  end_.kind = kind;
  end_.offset = good_offset_;
  end_.message = std::move(message);
  return false;
}

// The checksum is right and the content wrong: JournalWriter did not write this.
bool JournalReader::stop_at_nonsense() {
  return stop(JournalEnd::Kind::damaged, fmt::format("the frame at byte {} has impossible content", good_offset_));
}

bool JournalReader::read_frame(Frame& frame) {
  using Kind = JournalEnd::Kind;
  std::vector<std::byte> head;
  if (!read_exactly(*in_, kFrameHeadSize, head)) {
    return stop(Kind::cut_off, fmt::format("the journal breaks off at byte {}, without its close", good_offset_));
  }
  ByteSource in(head);
  const auto kind = in.get<std::uint8_t>();
  const auto length = in.get<std::uint32_t>();
  const auto checksum = in.get<std::uint64_t>();
  if (kind < static_cast<std::uint8_t>(FrameKind::header) || kind > static_cast<std::uint8_t>(FrameKind::close) ||
      length > journal_format::kMaxPayload) {
    return stop(Kind::damaged, fmt::format("the journal is damaged at byte {}: no frame begins there", good_offset_));
  }
  if (!read_exactly(*in_, length, frame.payload)) {
    return stop(Kind::cut_off, fmt::format("the journal breaks off in the frame at byte {}", good_offset_));
  }
  std::vector<std::byte> checked(head.begin(), head.begin() + 5);
  checked.insert(checked.end(), frame.payload.begin(), frame.payload.end());
  if (XXH3_64bits_withSeed(checked.data(), checked.size(), frames_) != checksum) {
    return stop(Kind::damaged,
                fmt::format("the journal is damaged in the frame at byte {}: its checksum is wrong", good_offset_));
  }
  frame.kind = static_cast<FrameKind>(kind);
  ++frames_;
  return true;
}

bool JournalReader::next_frame() {
  if (ended_) return false;
  good_offset_ += frame_size_;
  frame_size_ = 0;
  Frame frame;
  if (!read_frame(frame)) return false;
  frame_size_ = kFrameHeadSize + frame.payload.size();
  bool understood = false;
  switch (frame.kind) {
    case FrameKind::header:
      break;
    case FrameKind::ticks:
      understood = take_ticks(std::move(frame.payload));
      break;
    case FrameKind::loss:
      understood = take_loss(frame.payload);
      break;
    case FrameKind::close:
      understood = take_close(frame.payload);
      break;
  }
  if (!understood) return stop_at_nonsense();
  if (frame.kind != FrameKind::close) return true;
  good_offset_ += frame_size_;
  if (in_->peek() == std::char_traits<char>::eof()) return stop(JournalEnd::Kind::closed, {});
  return stop(JournalEnd::Kind::damaged, fmt::format("data after the closing record, at byte {}", good_offset_));
}

bool JournalReader::take_ticks(std::vector<std::byte> payload) {
  ticks_ = std::move(payload);
  ByteSource in(ticks_);
  const auto first = in.get<std::uint64_t>();
  const auto last = in.get<std::uint64_t>();
  if (!in.ok() || first != next_tick_ || last < first || last - first >= journal_format::kMaxTicksPerFrame)
    return false;
  ticks_at_ = ticks_.size() - in.remaining();
  frame_end_ = last + 1;
  return find_recorded(first);
}

// Reads how many ticks, from `from` on, are idle before the next one that is recorded.
bool JournalReader::find_recorded(std::uint64_t from) {
  ByteSource in(std::span<const std::byte>(ticks_).subspan(ticks_at_));
  if (in.remaining() == 0) {
    recorded_ = frame_end_;
    return true;
  }
  const std::uint64_t idle = in.get_varint();
  if (!in.ok() || idle >= frame_end_ - from) return false;
  ticks_at_ = ticks_.size() - in.remaining();
  recorded_ = from + idle;
  return true;
}

// Reads the recorded tick that lies at ticks_at_.
bool JournalReader::take_recorded() {
  ByteSource in(std::span<const std::byte>(ticks_).subspan(ticks_at_));
  current_.tick = recorded_;
  if (!decode_tick(in, current_)) return false;
  ticks_at_ = ticks_.size() - in.remaining();
  return find_recorded(recorded_ + 1);
}

bool JournalReader::take_loss(std::span<const std::byte> payload) {
  ByteSource in(payload);
  const auto first = in.get<std::uint64_t>();
  const auto count = in.get<std::uint64_t>();
  if (!in.ok() || in.remaining() != 0 || first != next_tick_ || count == 0 || count > ~first) return false;
  if (!end_.first_lost) end_.first_lost = first;
  end_.lost_ticks += count;
  next_tick_ += count;
  frame_end_ = next_tick_;
  after_loss_ = true;
  return true;
}

bool JournalReader::take_close(std::span<const std::byte> payload) {
  ByteSource in(payload);
  const auto ticks = in.get<std::uint64_t>();
  const auto lost = in.get<std::uint64_t>();
  const auto has_hash = in.get<std::uint8_t>();
  const auto hash = in.get<std::uint64_t>();
  if (!in.ok() || in.remaining() != 0 || ticks != end_.ticks || lost != end_.lost_ticks || has_hash > 1) return false;
  if (has_hash == 1) end_.hash = hash;
  return true;
}

bool JournalReader::next(JournalTick& out) {
  while (next_tick_ == frame_end_) {
    if (!next_frame()) return false;
  }
  if (ended_) return false;
  const bool idle = next_tick_ != recorded_;
  if (!idle && !take_recorded()) return stop_at_nonsense();
  if (idle) {
    current_.inputs = {};  // nobody was there
    current_.events.clear();
    current_.hash.reset();
  }
  current_.tick = next_tick_++;
  current_.after_loss = after_loss_;
  out = current_;
  ++end_.ticks;
  return true;
}

}  // namespace mechane::record
