#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <system_error>

namespace ACS::VDA5050
{

/// Whether another client uses the same client id: the broker closes the connection of the one when the other connects. MQTT 5
/// reports it. 3.1.1 only closes the connection, which is detected by repeated short connections. Pure.
class RivalDetector final
{
public:
    using Time = std::chrono::steady_clock::time_point;

    /// Of a connection, or of an attempt in vain.
    struct End
    {
        std::chrono::steady_clock::duration upTime{}; ///< Zero: it was never up.
        bool bRival = false;                          ///< Another client is the reason.
    };

    /// A connection of this duration is not short.
    static constexpr std::chrono::seconds STABLE_AFTER{5};

    /// Consecutive short connections that are no coincidence.
    static constexpr std::size_t SUSPICIOUS_COUNT = 3;

private:
    bool _bUniqueID;
    std::optional<Time> _upSince; ///< Empty while the link is down.
    std::size_t _shortCount = 0;

public:
    /// bUniqueID: the id is generated, so that no other client can have it.
    explicit RivalDetector(bool bUniqueID) noexcept;

    void OnUp(Time now) noexcept;

    [[nodiscard]] End OnEnd(Time now, const std::error_code& reason);
};

} // namespace ACS::VDA5050
