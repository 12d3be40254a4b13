#include "Profile.hpp"

namespace ACS::McsSim
{

Protocol::McsSessionOptions MakeSessionOptions(EProfile profile)
{
    Protocol::McsSessionOptions options;
    if (profile == EProfile::Nexus)
    {
        options.bSecondRefused = true;
        options.finalChunkBytes = NEXUS_BUFFER_BYTES;
        options.bErrorsUnanswered = true;
        options.bPositionsUnknown = true;
        options.bNullResults = true;
    }
    return options;
}

} // namespace ACS::McsSim
