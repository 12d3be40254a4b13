#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <utility>

namespace ACS::Core
{

/// A FIFO queue with a fixed capacity. Not shared between threads.
template <typename TElement>
class BoundedQueue
{
public:
    using value_type = TElement;                              ///< As in the standard containers, like the iterators.
    using iterator = typename std::deque<TElement>::iterator; ///< From the oldest element to the newest.
    using const_iterator = typename std::deque<TElement>::const_iterator; ///< From the oldest element to the newest.

private:
    std::size_t _capacity;
    std::deque<TElement> _elements;

public:
    /// An empty queue for at most this number of elements. 0: it is always full.
    explicit BoundedQueue(std::size_t capacity)
        : _capacity(capacity)
    {
    }

    /// Returns false and leaves the element unchanged if the queue is full.
    [[nodiscard]] bool TryPush(TElement&& element)
    {
        if (IsFull())
        {
            return false;
        }
        _elements.push_back(std::move(element));
        return true;
    }

    /// As above, with a copy of the element.
    [[nodiscard]] bool TryPush(const TElement& element)
    {
        if (IsFull())
        {
            return false;
        }
        _elements.push_back(element);
        return true;
    }

    /// The oldest element; null if the queue is empty. Valid until the queue is changed.
    [[nodiscard]] TElement* GetFrontOrNull() noexcept
    {
        return _elements.empty() ? nullptr : &_elements.front();
    }

    /// As above, for reading.
    [[nodiscard]] const TElement* GetFrontOrNull() const noexcept
    {
        return _elements.empty() ? nullptr : &_elements.front();
    }

    /// Removes and returns the oldest element; nullopt if the queue is empty.
    std::optional<TElement> PopFrontOrNull()
    {
        if (_elements.empty())
        {
            return std::nullopt;
        }
        std::optional<TElement> front(std::move(_elements.front()));
        _elements.pop_front();
        return front;
    }

    /// Removes all elements that match the predicate; returns their number.
    template <typename TPredicate>
    std::size_t EraseIf(TPredicate predicate)
    {
        return std::erase_if(_elements, std::move(predicate));
    }

    /// Removes all elements. The capacity stays.
    void Clear() noexcept
    {
        _elements.clear();
    }

    /// Whether PopFrontOrNull would return nullopt.
    [[nodiscard]] bool IsEmpty() const noexcept
    {
        return _elements.empty();
    }

    /// Whether TryPush would return false.
    [[nodiscard]] bool IsFull() const noexcept
    {
        return _elements.size() >= _capacity;
    }

    /// Number of elements.
    [[nodiscard]] std::size_t GetSize() const noexcept
    {
        return _elements.size();
    }

    /// Maximum number of elements, as it was passed to the constructor.
    [[nodiscard]] std::size_t GetCapacity() const noexcept
    {
        return _capacity;
    }

    /// From the oldest to the newest.
    [[nodiscard]] iterator begin() noexcept
    {
        return _elements.begin();
    }

    /// After the newest element.
    [[nodiscard]] iterator end() noexcept
    {
        return _elements.end();
    }

    /// From the oldest to the newest, for reading.
    [[nodiscard]] const_iterator begin() const noexcept
    {
        return _elements.begin();
    }

    /// After the newest element.
    [[nodiscard]] const_iterator end() const noexcept
    {
        return _elements.end();
    }
};

} // namespace ACS::Core
