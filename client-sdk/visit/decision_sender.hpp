// Tells the server what a visitor decided at a display, and in which language the visitor is shown the exhibit.
#pragma once

#include <memory>
#include <string>

#include "client-sdk/visit/visitor_panel.hpp"

namespace mechane::visit {

class DecisionSender {
 public:
  /// Takes the panel's requests. `presentation`: of the world that is shown; null: not known yet.
  void send(VisitorPanel& panel, client::Client& client,
            const std::shared_ptr<const client::WorldPresentation>& presentation);

 private:
  void tell_language(const std::string& language, client::Client& client,
                     const std::shared_ptr<const client::WorldPresentation>& presentation);

  std::string told_language_;
  std::shared_ptr<const client::WorldPresentation>
      told_presentation_;  ///< of the world that was last told the language
};

}  // namespace mechane::visit
