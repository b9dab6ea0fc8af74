#pragma once

namespace tessera {

/// Reads the command line and runs the command it names. Returns an ExitCode; throws std::exception whose what()
/// is fit for the user.
int run_command_line(int argc, char** argv);

} // namespace tessera
