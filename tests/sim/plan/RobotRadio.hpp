#pragma once

#include "ChanceModel.hpp"
#include "MemoryRobot.hpp"
#include "RobotMessages.hpp"
#include "Timeline.hpp"

#include <deque>

namespace ACS::Simulation
{

/// Receives from a robot over its radio.
class IRadioListener
{
public:
    IRadioListener() = default;
    IRadioListener(const IRadioListener&) = delete;
    IRadioListener& operator=(const IRadioListener&) = delete;
    virtual ~IRadioListener() = default;

    virtual void OnRadioUp() = 0;
    virtual void OnRadioDown() = 0;
    virtual void OnSnapshot(const RobotSnapshot& snapshot) = 0;
};

/// Carries messages between a robot and the running acsd, in order and delayed. Without a connection no message passes,
/// and messages in transit are lost from some message on.
class RobotRadio final
{
    /// One direction.
    struct Way
    {
        Core::SteadyTime lastArrival{};
        std::deque<Timeline::Ticket> underWay;
    };

    Timeline& _timeline;
    MemoryRobot& _robot;
    ChanceModel _chance;
    IRadioListener* _listenerOrNull = nullptr;
    Way _toRobot;
    Way _toListener;
    bool _bUp = true;
    bool _bListenerUp = false; ///< The state that the listener knows.
    std::uint64_t _epoch = 0;

public:
    RobotRadio(Timeline& timeline, MemoryRobot& robot, const ChanceSeed& seed);

    void Attach(IRadioListener& listener);
    /// acsd has crashed.
    void Detach(const IRadioListener& listener);
    void Send(const RobotMessage& message);
    void SetUp(bool bUp);
    [[nodiscard]] bool IsUp() const noexcept;

private:
    void Post(Way& way, Timeline::Task task);
    void Lose(Way& way);
    void NotifyLink(Core::Duration delay);
};

} // namespace ACS::Simulation
