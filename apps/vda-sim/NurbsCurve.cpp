#include "vda-sim/NurbsCurve.hpp"

#include <acs/vda5050/TrajectoryCurve.hpp>

namespace ACS::VdaSim
{

NurbsCurve MakeCurve(const VDA5050::Trajectory& trajectory)
{
    return NurbsCurve(VDA5050::MakeNurbs(trajectory));
}

} // namespace ACS::VdaSim
