#include "server/transport/exhibit_status.hpp"

#include <algorithm>

#include "server/transport/wire_texts.hpp"
#include <mechane/proto/convert.hpp>

namespace mechane::transport {

WireExhibits::WireExhibits(const ExhibitStatusData& data) : loadable_(proto::pointers_to(data.loadable)) {
  for (const OpenableExhibit& exhibit : data.exhibits) {
    proto::WireExhibit& wire = exhibits_.emplace_back();
    wire.id = proto::look_into(exhibit.id);
    wire.content_hash = proto::look_into(exhibit.content_hash);
    proto::look_into(wire.title, titles_.emplace_back(wire_texts(exhibit.title)));
    wire.worlds = exhibit.worlds;
    wire.former_worlds = exhibit.former_worlds;
  }
  for (const ExhibitAnswer& answer : data.answers) {
    answers_.push_back(
        {answer.id, proto::look_into(answer.refusal), proto::look_into(answer.place), proto::look_into(answer.remedy)});
  }
  wire_.protocol = proto::kProtocol;
  wire_.changeable = data.changeable;
  std::ranges::copy(data.key_mark, std::begin(wire_.key_mark));
  wire_.counter = data.counter;
  wire_.preparing = proto::look_into(data.preparing);
  proto::look_into(wire_.exhibits, exhibits_);
  proto::look_into(wire_.loadable, loadable_);
  proto::look_into(wire_.answers, answers_);
}

}  // namespace mechane::transport
