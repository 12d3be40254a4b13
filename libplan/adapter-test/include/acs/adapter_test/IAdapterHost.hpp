#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Now.hpp>
#include <acs/plan/IRobotAdapter.hpp>

#include <functional>

namespace ACS::AdapterTest
{

/// The host of one adapter.
class ACS_API IAdapterHost
{
public:
    /// Calls functions of the adapter, and appends what they append to out.
    using AdapterCall = std::function<void(Core::Now now, Planning::AdapterActions& out)>;

    IAdapterHost() = default;
    IAdapterHost(const IAdapterHost&) = delete;
    IAdapterHost& operator=(const IAdapterHost&) = delete;
    virtual ~IAdapterHost() = default;

    /// Calls the function with the current time and executes the actions that it appends. Every call of the adapter goes
    /// through it, except Handle and OnTimer, which the suite calls. The function is not called when the adapter is
    /// destroyed: that is a finding.
    virtual void Call(const AdapterCall& adapterCall) = 0;
};

} // namespace ACS::AdapterTest
