#include "common/config/CommandLine.hpp"
#include "OpenStreamSimOptions.hpp"
#include "OpenStreamSimProgram.hpp"

int main(int argc, char** argv)
{
    namespace Sim = ACS::OpenStreamSim;
    return ACS::Apps::RunProgram(Sim::PROGRAM_NAME, [argc, argv] { return Sim::RunOpenStreamSim(argc, argv); });
}
