#include "client-sdk/client/exhibit_parse.hpp"

#include <algorithm>

#include "client-sdk/client/clean_text.hpp"
#include <mechane/proto/convert.hpp>

namespace mechane::client {

bool parse(const proto::ExhibitStatus& wire, ExhibitStatus& out) {
  const auto exhibits = proto::elements(wire.exhibits);
  const auto loadable = proto::elements(wire.loadable);
  const auto answers = proto::elements(wire.answers);
  if (wire.protocol != proto::kProtocol || !proto::is_name(proto::text_of(wire.server))) return false;
  if (exhibits.size() > kMaxExhibits || loadable.size() > kMaxExhibits || answers.size() > kMaxExhibitAnswers)
    return false;
  out = {};
  out.server = proto::text_of(wire.server);
  out.incarnation = wire.incarnation;
  out.changeable = wire.changeable;
  std::ranges::copy(wire.key_mark, out.key_mark.begin());
  out.counter = wire.counter;
  out.preparing = one_line(wire.preparing);
  for (const proto::WireExhibit& exhibit : exhibits) {
    const auto titles = proto::elements(exhibit.title);
    if (titles.size() > mechane_kMaxLanguages) return false;
    OpenableExhibit& one = out.exhibits.emplace_back();
    one.id = one_line(exhibit.id);
    one.content_hash = one_line(exhibit.content_hash);
    one.worlds = exhibit.worlds;
    one.former_worlds = exhibit.former_worlds;
    for (const proto::WireText& text : titles)
      one.title[clean(text.language)] = one_line(text.content);
  }
  for (const char* name : loadable)
    out.loadable.push_back(one_line(name));
  for (const proto::WireExhibitAnswer& answer : answers) {
    out.answers.push_back({answer.id, one_line(answer.refusal), one_line(answer.place), one_line(answer.remedy)});
  }
  return true;
}

}  // namespace mechane::client
