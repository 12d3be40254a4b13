#include "wire/Profile.hpp"

namespace ACS::McsSim
{

McsBehaviour MakeBehaviour(EProfile profile)
{
    McsBehaviour behaviour;
    if (profile == EProfile::Nexus)
    {
        behaviour.finalChunkBytes = NEXUS_BUFFER_BYTES;
        behaviour.bErrorsUnanswered = true;
        behaviour.bPositionsUnknown = true;
        behaviour.bNullResults = true;
    }
    return behaviour;
}

} // namespace ACS::McsSim
