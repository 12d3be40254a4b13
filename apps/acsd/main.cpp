#include "AcsdProgram.hpp"
#include "common/config/CommandLine.hpp"

int main(int argc, char** argv)
{
    return ACS::Apps::RunProgram("acsd", [argc, argv] { return ACS::Acsd::RunAcsd(argc, argv); });
}
