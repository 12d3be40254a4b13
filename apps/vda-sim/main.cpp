#include "vda-sim/VdaSim.hpp"

int main(int argc, char** argv)
{
    return ACS::Apps::RunProgram("vda-sim", [argc, argv]() {
        ACS::VdaSim::VdaSimOptions options;
        const std::optional<int> exitCode = ACS::VdaSim::ReadCommandLineOrNull(argc, argv, options);
        return exitCode.has_value() ? *exitCode : ACS::VdaSim::RunVdaSim(options);
    });
}
