#include <acs/acsd/RunAcsd.hpp>

int main(int argc, char** argv)
{
    return ACS::Acsd::RunAcsd(argc, argv, {});
}
