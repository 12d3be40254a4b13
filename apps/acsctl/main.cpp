#include "commands/CompletionCommand.hpp"
#include "common/config/CommandLine.hpp"
#include "ExitCodes.hpp"
#include "options/AcsctlParser.hpp"
#include "Program.hpp"

#include <iostream>
#include <optional>
#include <string>
#include <vector>

int main(int argc, char** argv)
{
    return ACS::Apps::RunProgram(ACS::Acsctl::PROGRAM_NAME, [argc, argv] {
        const std::vector<std::string> arguments(argv, argv + argc);
        if (arguments.size() > 1 && arguments[1] == ACS::Acsctl::COMPLETE_WORD)
        {
            std::cout << ACS::Acsctl::RunCompletion(
                {arguments.begin() + 2, arguments.end()},
                ACS::Acsctl::ReadEnvironment());
            return ACS::Acsctl::EXIT_DONE;
        }
        ACS::Acsctl::AcsctlOptions options;
        const std::optional<int> exitCode = ACS::Acsctl::ParseOptionsOrNull(arguments, options);
        return exitCode.has_value() ? *exitCode : ACS::Acsctl::Run(options, ACS::Acsctl::ReadEnvironment());
    });
}
