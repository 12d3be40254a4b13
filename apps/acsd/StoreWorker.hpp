#pragma once

#include <acs/core/Result.hpp>
#include <acs/plan/IPlanStore.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <functional>
#include <memory>

namespace ACS::Acsd
{

/// A store in a thread of its own: a disk takes milliseconds, in which acsd reads what comes in. Called and answered on the
/// executor's thread.
class StoreWorker final
{
    struct Impl;
    std::shared_ptr<Impl> _impl;

public:
    using StoredHandler = std::function<void(const Core::Result<void>& result)>;

    StoreWorker(
        const boost::asio::any_io_executor& executor,
        std::unique_ptr<Planning::IPlanStore> store,
        StoredHandler handler);
    StoreWorker(const StoreWorker&) = delete;
    StoreWorker& operator=(const StoreWorker&) = delete;

    /// Waits until what was begun is on disk; the handler is not called any more.
    ~StoreWorker();

    /// One batch after the other, each answered by one call of the handler, never from within.
    void Append(const Planning::StoreBatch& batch);
};

} // namespace ACS::Acsd
