#include "common/config/CommandLine.hpp"
#include "McsSimOptions.hpp"
#include "Program.hpp"

#include <optional>

int main(int argc, char** argv)
{
    return ACS::Apps::RunProgram(ACS::McsSim::PROGRAM_NAME, [argc, argv] {
        ACS::McsSim::McsSimOptions options;
        const std::optional<int> exitCode = ACS::McsSim::ParseOptionsOrNull(argc, argv, options);
        return exitCode.has_value() ? *exitCode : ACS::McsSim::Run(options);
    });
}
