#include <optional>

#include "morsel/core/error.h"
#include "morsel/tools/batch/state.h"
#include "support/scratch.h"
#include "target.h"

void morsel::fuzz::state(std::string_view bytes) {
  static const test::Scratch kFolder;
  try {
    const std::optional<tools::batch::MeshState> state = tools::batch::parse_state(bytes, "fuzz");
    if (!state) return;
    tools::batch::is_settled(*state, state->key, state->limits, {});
    const std::filesystem::path path = kFolder / "state";
    tools::batch::write_state(path, *state);
    const std::optional<tools::batch::MeshState> again = tools::batch::read_state(path);
    require(again && again->key == state->key && again->files == state->files &&
                again->seconds == state->seconds && again->result == state->result &&
                again->timings == state->timings && again->error.has_value() == state->error.has_value() &&
                again->limits == state->limits,
            "a state written and read again");
    if (state->error)
      require(again->error->message == state->error->message && again->error->kind == state->error->kind &&
                  again->error->signal == state->error->signal &&
                  again->error->exit_code == state->error->exit_code,
              "an error written and read again");
  } catch (const core::BadInput&) {
  }
}
