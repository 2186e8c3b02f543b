// bounce view: the window.
#include "app/commands/command.h"
#include "core/error.h"

namespace bounce {
void add_view_command(CLI::App&, CommandFunction&) {}
int run_default() {
    return render_default();
}
} // namespace bounce
