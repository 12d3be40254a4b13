#include "RobotHand.hpp"

#include <utility>

namespace ACS::Simulation
{

RobotHand::RobotHand(Timeline& timeline, RobotRadio& radio, std::uint64_t number, EventHandler handler)
    : _radio(radio),
      _adapter(number, [this](const RobotMessage& message) { _radio.Send(message); }),
      _runner(timeline, _adapter, std::move(handler), {})
{
    _radio.Attach(*this);
}

RobotHand::~RobotHand()
{
    _radio.Detach();
}

void RobotHand::Handle(const Planning::RobotCommand& command)
{
    _runner.Run([this, &command](Core::Now now, auto& out) { _adapter.Handle(command, now, out); });
}

void RobotHand::OnRadioUp()
{
    _runner.Run([this](Core::Now /*now*/, auto& out) { _adapter.OnLinkUp(out); });
}

void RobotHand::OnRadioDown()
{
    _runner.Run([this](Core::Now /*now*/, auto& out) { _adapter.OnLinkDown(out); });
}

void RobotHand::OnSnapshot(const RobotSnapshot& snapshot)
{
    _runner.Run([this, &snapshot](Core::Now /*now*/, auto& out) { _adapter.OnSnapshot(snapshot, out); });
}

} // namespace ACS::Simulation
