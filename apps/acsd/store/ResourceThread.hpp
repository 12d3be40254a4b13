#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/thread_pool.hpp>

#include <memory>
#include <utility>

namespace ACS::Acsd
{

/// Calls a resource whose calls block, such as a store, in a thread of its own: one call after the other. Used on the thread of the
/// executor, where the answers are handled too.
template <typename TResource>
class ResourceThread final
{
    struct State
    {
        boost::asio::any_io_executor executor;
        std::unique_ptr<TResource> resource;
        bool bEnded = false; ///< Read on the executor's thread only.
        boost::asio::thread_pool thread{1};
    };

    std::shared_ptr<State> _state;

public:
    ResourceThread(const boost::asio::any_io_executor& executor, std::unique_ptr<TResource> resource)
        : _state(std::make_shared<State>())
    {
        _state->executor = executor;
        _state->resource = std::move(resource);
    }

    ResourceThread(const ResourceThread&) = delete;
    ResourceThread& operator=(const ResourceThread&) = delete;

    /// Waits until all calls that were asked for are done. Handles no answer any more.
    ~ResourceThread()
    {
        _state->bEnded = true;
        _state->thread.join();
    }

    /// Does the work in the thread, with the resource as its argument, and handles its result on the executor, never from within this
    /// call.
    template <typename TWork, typename TAnswer>
    void Do(TWork work, TAnswer answer)
    {
        // The resource outlives the work: the destructor waits.
        boost::asio::post(
            _state->thread,
            [weak = std::weak_ptr(_state), &resource = *_state->resource, work, answer]() {
                auto result = work(resource);
                const std::shared_ptr<State> state = weak.lock();
                if (state == nullptr)
                {
                    return;
                }
                boost::asio::post(state->executor, [weak, answer, result = std::move(result)]() {
                    const std::shared_ptr<State> owned = weak.lock();
                    if (owned != nullptr && !owned->bEnded)
                    {
                        answer(result);
                    }
                });
            });
    }
};

} // namespace ACS::Acsd
