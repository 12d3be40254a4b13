#pragma once

#include "replay/CoreInput.hpp"
#include "replay/ICoreRecorder.hpp"

namespace ACS::Acsd
{

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
