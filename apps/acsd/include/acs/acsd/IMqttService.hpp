#pragma once

#include <acs/core/Api.hpp>
#include <acs/vda5050/IMqttLink.hpp>

namespace ACS::Acsd
{

/// acsd's connection to the broker of the table `mqtt`, as one robot uses it. Messages on its topics, which begin with
/// RobotCapabilities::topicPrefix, are passed to its listener, and all messages in both directions to the trace of acsd. Called on
/// the executor's thread only.
///
/// Publish fails with std::errc::not_connected without a connection, with Core::ECoreError::QueueFull if too many messages wait.
/// A subscription outside of the robot's topics is not made, and logged as an error. A robot may publish to any topic.
class ACS_API IMqttService : public VDA5050::IMqttLink
{
public:
    /// The listener receives the messages and the states of the connection from now on; nullptr: nothing any more. Set it and
    /// subscribe in IRobot::Start: acsd connects afterwards, so that OnLinkUp follows each connect. Nothing is received after
    /// IRobot::Stop.
    virtual void SetListener(VDA5050::IMqttLinkListener* listenerOrNull) = 0;
};

} // namespace ACS::Acsd
