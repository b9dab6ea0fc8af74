#pragma once

namespace CLI {
class App;
} // namespace CLI

namespace tessera {

/// Makes the help of each command with many options list them in groups, the essential ones first.
void group_help(CLI::App& app);

} // namespace tessera
