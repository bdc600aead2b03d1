// RAII over Cyclone DDS' C API: participants, typed writers and readers.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include <dds/dds.h>

#include "server/base/error.hpp"
#include <mechane/proto/topics.hpp>

namespace mechane::proto {

/// Owns one DDS entity. Deleting it waits until its listeners have returned.
class Entity {
 public:
  Entity() = default;
  explicit Entity(dds_entity_t handle) : handle_(handle) {}
  Entity(Entity&& other) noexcept : handle_(std::exchange(other.handle_, 0)) {}
  Entity& operator=(Entity&& other) noexcept {
    if (this != &other) {
      reset();
      handle_ = std::exchange(other.handle_, 0);
    }
    return *this;
  }
  ~Entity() { reset(); }
  void reset() {
    if (handle_ > 0) dds_delete(std::exchange(handle_, 0));
  }
  [[nodiscard]] dds_entity_t get() const { return handle_; }
  explicit operator bool() const { return handle_ > 0; }

 private:
  dds_entity_t handle_ = 0;
};

/// The error of a DDS call: io_failure.
[[nodiscard]] Error dds_error(dds_return_t code, const std::string& doing, const std::string& where);

/// One process in a DDS domain. The network is set up by CYCLONEDDS_URI.
class Participant {
 public:
  /// Errors: invalid_value (a domain over 230); not_found (the file of CYCLONEDDS_URI); unknown_name (an interface in it: the error lists
  /// those that exist); io_failure.
  [[nodiscard]] static Expected<Participant> create(std::uint32_t domain);
  [[nodiscard]] dds_entity_t get() const { return entity_.get(); }

 private:
  explicit Participant(Entity entity) : entity_(std::move(entity)) {}
  Entity entity_;
};

/// What DDS says about a sample that was taken.
struct SampleInfo {
  bool valid = false;  ///< all fields; otherwise only the key's
  bool alive = false;  ///< the instance has a live writer and was not disposed
};

/// Takes samples from a reader. Listeners are given one; Reader::view() makes one.
template <TopicType T>
class ReaderView {
 public:
  explicit ReaderView(dds_entity_t reader) : reader_(reader) {}

  /// Takes one sample into the caller's storage, without the heap. False when there is no sample.
  bool take_into(T& out, SampleInfo& info) const noexcept requires FixedSize<T> {
    void* storage = &out;
    dds_sample_info_t raw;
    if (dds_take(reader_, &storage, &raw, 1, 1) != 1) return false;
    info = to_info(raw);
    return true;
  }

  /// Takes all samples and calls f(const T&, const SampleInfo&) for each, oldest first within a key.
  template <class F>
  void take_each(F&& f) const {
    constexpr std::uint32_t kBatch = 32;
    for (;;) {
      std::array<void*, kBatch> samples{};
      std::array<dds_sample_info_t, kBatch> raw;
      const dds_return_t n = dds_take(reader_, samples.data(), raw.data(), kBatch, kBatch);
      if (n <= 0) return;
      for (dds_return_t i = 0; i < n; ++i) {
        const auto index = static_cast<std::size_t>(i);
        f(*static_cast<const T*>(samples[index]), to_info(raw[index]));
      }
      dds_return_loan(reader_, samples.data(), n);
    }
  }

 private:
  static SampleInfo to_info(const dds_sample_info_t& raw) noexcept {
    return {raw.valid_data, raw.instance_state == DDS_IST_ALIVE};
  }
  dds_entity_t reader_;
};

/// A reader, with its own topic entity. on_data runs on a receiving thread of Cyclone's, one call at a time.
template <TopicType T>
class Reader {
 public:
  using OnData = std::function<void(ReaderView<T>)>;

  Reader() = default;
  Reader(Reader&& other) noexcept = default;
  /// Deletes the old reader before the function that its listener calls; a default assignment would do it in the other order.
  Reader& operator=(Reader&& other) noexcept {
    if (this == &other) return *this;
    reader_.reset();
    topic_ = std::move(other.topic_);
    on_data_ = std::move(other.on_data_);
    reader_ = std::move(other.reader_);
    return *this;
  }
  ~Reader() = default;
  /// Partition "": the default one. `on_data` may be empty: then poll view(). Errors: io_failure (out of memory, or a broken participant).
  [[nodiscard]] static Expected<Reader> create(const Participant& participant, const std::string& partition,
                                               OnData on_data = {});

  [[nodiscard]] ReaderView<T> view() const { return ReaderView<T>(reader_.get()); }
  /// How many writers match now.
  [[nodiscard]] std::uint32_t matched() const {
    dds_subscription_matched_status_t status{};
    return dds_get_subscription_matched_status(reader_.get(), &status) == 0 ? status.current_count : 0;
  }
  explicit operator bool() const { return static_cast<bool>(reader_); }

 private:
  std::unique_ptr<OnData> on_data_;  // keeps its address when the Reader is moved: the listener has a pointer to it
  Entity topic_;
  Entity reader_;  // last: deleted first, so that no listener outlives on_data_
};

/// A writer, with its own topic entity.
template <TopicType T>
class Writer {
 public:
  Writer() = default;
  [[nodiscard]] static Expected<Writer> create(const Participant& participant, const std::string& partition);

  /// False when DDS refused: a reliable reader is behind, or memory is short.
  bool write(const T& sample) noexcept { return dds_write(writer_.get(), &sample) == DDS_RETCODE_OK; }
  /// Takes the sample's key off the wire: readers see it as not alive.
  bool dispose(const T& sample) noexcept { return dds_dispose(writer_.get(), &sample) == DDS_RETCODE_OK; }
  [[nodiscard]] std::uint32_t matched() const {
    dds_publication_matched_status_t status{};
    return dds_get_publication_matched_status(writer_.get(), &status) == 0 ? status.current_count : 0;
  }
  explicit operator bool() const { return static_cast<bool>(writer_); }

 private:
  Entity topic_;
  Entity writer_;
};

template <TopicType T>
Expected<Reader<T>> Reader<T>::create(const Participant& participant, const std::string& partition, OnData on_data) {
  const std::string where = std::string("reader of ") + TopicOf<T>::name;
  Reader reader;
  const dds_entity_t topic =
      dds_create_topic(participant.get(), TopicOf<T>::descriptor, TopicOf<T>::name, nullptr, nullptr);
  if (topic < 0) return tl::unexpected<Error>(dds_error(topic, "making the topic", where));
  reader.topic_ = Entity(topic);
  Qos qos = TopicOf<T>::qos();
  if (!partition.empty()) qos.partition(partition);
  std::unique_ptr<dds_listener_t, void (*)(dds_listener_t*)> listener(nullptr, dds_delete_listener);
  if (on_data) {
    reader.on_data_ = std::make_unique<OnData>(std::move(on_data));
    listener.reset(dds_create_listener(reader.on_data_.get()));
    dds_lset_data_available(
        listener.get(), [](dds_entity_t handle, void* arg) { (*static_cast<OnData*>(arg))(ReaderView<T>(handle)); });
  }
  const dds_entity_t handle = dds_create_reader(participant.get(), topic, qos.get(), listener.get());
  if (handle < 0) return tl::unexpected<Error>(dds_error(handle, "making the reader", where));
  reader.reader_ = Entity(handle);
  return reader;
}

template <TopicType T>
Expected<Writer<T>> Writer<T>::create(const Participant& participant, const std::string& partition) {
  const std::string where = std::string("writer of ") + TopicOf<T>::name;
  Writer writer;
  const dds_entity_t topic =
      dds_create_topic(participant.get(), TopicOf<T>::descriptor, TopicOf<T>::name, nullptr, nullptr);
  if (topic < 0) return tl::unexpected<Error>(dds_error(topic, "making the topic", where));
  writer.topic_ = Entity(topic);
  Qos qos = TopicOf<T>::qos();
  if (!partition.empty()) qos.partition(partition);
  const dds_entity_t handle = dds_create_writer(participant.get(), topic, qos.get(), nullptr);
  if (handle < 0) return tl::unexpected<Error>(dds_error(handle, "making the writer", where));
  writer.writer_ = Entity(handle);
  return writer;
}

}  // namespace mechane::proto
