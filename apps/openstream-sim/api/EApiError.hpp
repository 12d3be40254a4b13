#pragma once

#include <cstdint>

namespace ACS::OpenStreamSim
{

/// The err_code of a refusal. "Own" marks numbers of the simulator, for refusals without a number in the manuals.
enum class EApiError : std::int32_t
{
    None = 0,
    BadInput = -1,             ///< 400: query or body. Own.
    NotServed = -2,            ///< 404: no such path, or not with this method. Own.
    NoProgram = -3,            ///< 403: start without a selected program. Own.
    EmergencyStop = -4,        ///< 403: the emergency stop is pressed. Own.
    BufferFull = -8,           ///< 403: more points than the trajectory buffer has room for.
    BufferLeft = -101,         ///< 403: points of a stopped trajectory are still in the buffer. Own.
    RemoteSelection = -102,    ///< 403: ext_sel 0, which remote mode forbids. Own.
    Withdrawn = -103,          ///< 403: an endpoint that this version of the controller no longer serves. Own.
    NotInWait = -104,          ///< 403: release_wait while no program waits. Own.
    AxisTooFast = -159,        ///< 403: likewise, after alarm E159. Own.
    NotWaiting = -1554,        ///< 403: no program waits in playback (alarm E01554). Own.
    NotRemote = -38500,        ///< 403
    TaskPlaying = -38501,      ///< 403
    LocalSelection = -1114208, ///< 403: ext_sel 1 outside of remote mode.
    BadCounter = -1245280,     ///< 403: no such program counter, or it was not set after a start or stop.
    Language = -1376272,       ///< 403: not a statement of the robot language.
    MotorOff = -1442071,       ///< 403
    Playing = -1442080,        ///< 403: an automatic program runs.
    ProtectiveStop = -5,       ///< 403: the safeguard is open. Own.
};

} // namespace ACS::OpenStreamSim
