#pragma once

#include "ChanceModel.hpp"
#include "MemoryRobot.hpp"
#include "RobotMessages.hpp"
#include "Timeline.hpp"

#include <deque>

namespace ACS::Simulation
{

/// What hears a robot over its radio.
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

/// Carries messages between a robot and the acsd of the moment: in order and late; while it is down nothing passes, and
/// what was under way is lost from some message on.
class RobotRadio final
{
    /// To one end.
    struct Way
    {
        Core::SteadyTime lastArrival{};
        std::deque<Timeline::Ticket> underWay;
    };

    Timeline& _timeline;
    MemoryRobot& _robot;
    ChanceModel _dice;
    IRadioListener* _listenerOrNull = nullptr;
    Way _toRobot;
    Way _toListener;
    bool _bUp = true;
    bool _bListenerUp = false; ///< What the listener was told.
    std::uint64_t _epoch = 0;

public:
    RobotRadio(Timeline& timeline, MemoryRobot& robot, const ChanceSeed& seed);

    void Attach(IRadioListener& listener);
    /// It has died.
    void Detach();
    void Send(const RobotMessage& message);
    void SetUp(bool bUp);
    [[nodiscard]] bool IsUp() const noexcept;

private:
    void Post(Way& way, Timeline::Task task);
    void Lose(Way& way);
    void TellLink(Core::Duration delay);
};

} // namespace ACS::Simulation
