#include "client-sdk/visit/decision_sender.hpp"

#include <algorithm>

#include "server/log/log.hpp"

namespace mechane::visit {

void DecisionSender::send(VisitorPanel& panel, client::Client& client,
                          const std::shared_ptr<const client::WorldPresentation>& presentation) {
  const VisitorRequests requests = panel.take_requests();
  if (requests.home) (void)client.open_exhibit("");
  for (const client::VisitAnswer& given : requests.answers) {
    if (client.answer(given) == 0)
      log::warning("an answer to '" + given.question + "' was not sent: the display is in no world");
  }
  tell_language(panel.language(), client, presentation);
}

/// The visit's record says in which language the visitor was shown the exhibit: told once a world, and when it changes.
void DecisionSender::tell_language(const std::string& language, client::Client& client,
                                   const std::shared_ptr<const client::WorldPresentation>& presentation) {
  if (!presentation || presentation->languages.empty() || client.state() != client::LinkState::joined) return;
  const auto& known = presentation->languages;
  const bool speaks_it = std::ranges::count(known, language) > 0;
  const std::string& shown = speaks_it ? language : known.front();
  if (told_presentation_ == presentation && told_language_ == shown) return;
  if (client.tell_language(shown) == 0) return;
  told_presentation_ = presentation;
  told_language_ = shown;
}

}  // namespace mechane::visit
