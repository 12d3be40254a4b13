#include "common/config/CommandLine.hpp"
#include "SimulationRunner.hpp"

int main(int argc, char** argv)
{
    return ACS::Apps::RunProgram("plan_simulation", [argc, argv] {
        ACS::Simulation::SimulationOptions options;
        const std::optional<int> exitCode = ACS::Simulation::ReadOptionsOrNull(argc, argv, options);
        return exitCode.has_value() ? *exitCode : ACS::Simulation::SimulationRunner(options).Run();
    });
}
