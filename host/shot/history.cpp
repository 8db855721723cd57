#include "shot/history.h"

#include "base/hash.h"
#include "gloam/error.h"

namespace gloam {

std::string add_history_to(FrameMaking& making, const std::string& before) {
  making.settings += fmt::format(" history {}", before.empty() ? "none" : before);
  return fmt::format("{:016x}", hash_of(before + making.input));
}

bool ShotHistory::follow(const FrameTurn& turn, const std::vector<std::string>& planes, FrameMaking& making) {
  if (turn.begins || !last_ || *last_ + 1 != turn.index) chain.begin_anew();
  files_ = add_history_to(making, chain.holds_any() ? files_ : "");
  if (!chain.holds_any() || !motion_leads_elsewhere(planes, turn.before, turn.frame.number)) return false;
  chain.begin_anew();
  return true;
}

}  // namespace gloam
