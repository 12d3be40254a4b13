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

/// One input of AcsdCore, from its creation to its destruction.
class RecordedInput final
{
    ICoreRecorder* _recorderOrNull;

public:
    /// Makes the input only if there is a recorder.
    template <typename TMake>
    RecordedInput(ICoreRecorder* recorderOrNull, const TMake& make)
        : _recorderOrNull(recorderOrNull)
    {
        if (_recorderOrNull != nullptr)
        {
            _recorderOrNull->BeginInput(CoreInput(make()));
        }
    }

    RecordedInput(const RecordedInput&) = delete;
    RecordedInput& operator=(const RecordedInput&) = delete;

    ~RecordedInput()
    {
        if (_recorderOrNull != nullptr)
        {
            _recorderOrNull->EndInput();
        }
    }
};

} // namespace ACS::Acsd
