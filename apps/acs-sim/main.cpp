#include "AcsSimOptions.hpp"
#include "common/config/CommandLine.hpp"
#include "Program.hpp"

#include <optional>

int main(int argc, char** argv)
{
    return ACS::Apps::RunProgram(ACS::AcsSim::PROGRAM_NAME, [argc, argv] {
        ACS::AcsSim::AcsSimOptions options;
        const std::optional<int> exitCode = ACS::AcsSim::ParseOptionsOrNull(argc, argv, options);
        return exitCode.has_value() ? *exitCode : ACS::AcsSim::Run(options);
    });
}
