#include "app/panels/pass_switch.h"

#include "app/panels/parameter_edit.h"

#include <fmt/format.h>

namespace bounce {

static void set_enabled(Session& session, UiState& ui, const std::vector<std::string>& ids, bool on) {
    for (const std::string& id : ids)
        if (PassNode* node = session.graph().model().find_node(id)) node->enabled = on;
    ui.redraw();
}

void switch_pass(PanelContext& context, const std::string& id, bool on) {
    Session& session = context.session;
    UiState& ui = context.ui;
    std::vector<std::string> ids{id};
    if (on) ids = session.graph().model().off_before(id);
    set_enabled(session, ui, ids, on); // a frame that is being rendered goes by its plan, and does not ask for it
    ui.change_graph([&session, &ui, &undo = context.undo, ids, id, on] {
        if (const std::string why = plan_refusal(session); !why.empty()) {
            set_enabled(session, ui, ids, !on);
            if (plan_refusal(session).empty())
                return ui.say(fmt::format("{}: {} stays {}", why, id, on ? "off" : "on"), true);
            set_enabled(session, ui, ids, on); // it was wrong before: this may be one of several steps to mend it
        }
        undo.push({(on ? "switch on " : "switch off ") + id,
                   [&session, &ui, ids, on] { set_enabled(session, ui, ids, !on); },
                   [&session, &ui, ids, on] { set_enabled(session, ui, ids, on); }});
    });
}

} // namespace bounce
