#pragma once

#include "replay/CoreInput.hpp"
#include <acs/plan/RobotEvent.hpp>

#include <string>

namespace ACS::Acsd
{

/// Receives every input of AcsdCore before it takes effect.
class ICoreRecorder
{
public:
    ICoreRecorder() = default;
    ICoreRecorder(const ICoreRecorder&) = delete;
    ICoreRecorder& operator=(const ICoreRecorder&) = delete;
    virtual ~ICoreRecorder() = default;

    /// Inputs may be nested: an output may lead to an input within its call.
    virtual void BeginInput(const CoreInput& input) = 0;
    /// Of the latest input that has not ended.
    virtual void EndInput() = 0;

    /// The event to be used instead, whose job check is recorded.
    [[nodiscard]] virtual Planning::RobotEvent Watch(const std::string& robotID, const Planning::RobotEvent& event) = 0;
};

} // namespace ACS::Acsd
