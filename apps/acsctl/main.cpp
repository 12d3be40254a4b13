#include "common/config/CommandLine.hpp"
#include "options/AcsctlParser.hpp"
#include "Program.hpp"

#include <optional>
#include <string>
#include <vector>

int main(int argc, char** argv)
{
    return ACS::Apps::RunProgram(ACS::Acsctl::PROGRAM_NAME, [argc, argv] {
        const std::vector<std::string> arguments(argv, argv + argc);
        ACS::Acsctl::AcsctlOptions options;
        const std::optional<int> exitCode = ACS::Acsctl::ParseOptionsOrNull(arguments, options);
        return exitCode.has_value() ? *exitCode : ACS::Acsctl::Run(options, ACS::Acsctl::ReadEnvironment());
    });
}
