# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What browsers get, and what pages of elsewhere, slow browsers and crowds do not."""

import asyncio
import json
import socket
import threading
import time

import pytest

pytest.importorskip('aiohttp', reason="pip install 'tactile_push[watch]'")

import aiohttp

from tactile_push.watching import server as module
from tactile_push.watching.server import Server

HEADERS = {'Content-Security-Policy': "default-src 'none'"}


@pytest.fixture
def server():
    server = Server('127.0.0.1', 0, '<p>page</p>', HEADERS, lambda: 'hello')
    yield server
    server.close()


def talk(conversation, **options):
    """Run a conversation with a client of its own."""

    async def run():
        async with aiohttp.ClientSession(**options) as session:
            return await conversation(session)

    return asyncio.run(asyncio.wait_for(run(), 30.0))


def live(session, server, **headers):
    """Open what a page opens."""
    origin = {'Origin': server.address.rstrip('/')}
    return session.ws_connect(f'{server.address}live', headers=origin | headers)


def test_page_comes_with_its_headers(server):
    async def conversation(session):
        async with session.get(server.address) as answer:
            return answer.status, answer.content_type, await answer.text(), answer.headers

    status, kind, text, headers = talk(conversation)
    assert (status, kind, text) == (200, 'text/html', '<p>page</p>')
    assert headers['Content-Security-Policy'] == "default-src 'none'"


def test_first_the_greeting_and_then_what_is_posted(server):
    async def conversation(session):
        async with live(session, server) as page:
            assert await page.receive_str() == 'hello'
            server.post('frame', '1')
            assert await page.receive_str() == '1'
            server.post('frame', '2')
            assert await page.receive_str() == '2'
        server.post('events', 'a')
        async with live(session, server) as late:
            return [await late.receive_str() for _ in range(3)]

    assert talk(conversation) == ['hello', '2', 'a']


@pytest.mark.parametrize(
    'origin',
    [
        'http://evil.example',
        'http://127.0.0.1',
        'http://127.0.0.1:1',
        'https://127.0.0.1:{port}',
        'http://localhost:{port}',
        'null',
        '',
    ],
)
def test_pages_of_elsewhere_are_refused(server, origin):
    port = server.address.rstrip('/').rpartition(':')[2]

    async def conversation(session):
        with pytest.raises(aiohttp.WSServerHandshakeError) as refused:
            await live(session, server, Origin=origin.format(port=port))
        return refused.value.status

    assert talk(conversation) == 403
    assert server.pages == 0


@pytest.mark.parametrize(
    ('host', 'status'),
    [
        ('evil.example', 403),
        ('127.0.0.1.evil.example:80', 403),
        ('[x]:80', 403),
        ('', 403),
        ('localhost', 200),
        ('LOCALHOST:8765', 200),
        ('[::1]:1', 200),
        ('192.168.1.5:8765', 200),
        (socket.gethostname(), 200),
        (f'{socket.gethostname()}.local:8765', 200),
    ],
)
def test_names_that_somebody_lets_lead_here_are_refused(server, host, status):
    async def conversation(session):
        for path in ('', 'live', 'nowhere'):
            async with session.get(f'{server.address}{path}', headers={'Host': host}) as answer:
                yield answer.status

    async def statuses(session):
        return [status async for status in conversation(session)]

    page, _, nowhere = talk(statuses)
    assert page == status
    assert nowhere == (404 if status == 200 else 403)


def test_a_slow_page_misses_frames_and_gets_the_newest(server):
    size, count = 1000, 5000  # more than all buffers on the way

    async def conversation(session):
        async with live(session, server) as page:
            await page.receive_str()
            transport = page._response.connection.transport
            transport.pause_reading()
            for k in range(count):
                server.post('frame', json.dumps([k] + [0] * size))
                if k % 50 == 0:
                    await asyncio.sleep(0.001)
            server.post('last', 'over')
            transport.resume_reading()
            got = []
            while (text := await page.receive_str()) != 'over':
                got.append(json.loads(text)[0])
            return got

    got = talk(conversation)
    assert got == sorted(got)
    assert len(got) < count // 2
    assert got[-1] == count - 1


def test_a_page_that_takes_nothing_is_given_up(server, monkeypatch):
    monkeypatch.setattr(module, 'STALLED', 0.2)

    async def conversation(session):
        page = await live(session, server)
        await page.receive_str()
        page._response.connection.transport.pause_reading()
        text = 'x' * 100_000
        while server.pages:
            server.post('frame', text + str(time.monotonic()))
            await asyncio.sleep(0.01)

    talk(conversation)


def test_more_pages_than_many_are_refused(server, monkeypatch):
    monkeypatch.setattr(module, 'MOST_PAGES', 2)

    async def conversation(session):
        pages = [await live(session, server) for _ in range(2)]
        with pytest.raises(aiohttp.WSServerHandshakeError) as refused:
            await live(session, server)
        assert (refused.value.status, server.pages) == (503, 2)
        await pages[0].close()
        while server.pages == 2:
            await asyncio.sleep(0.01)
        await (await live(session, server)).close()

    talk(conversation)


def test_a_page_that_speaks_much_is_cut_off(server):
    async def conversation(session):
        async with live(session, server) as page:
            await page.send_str('x' * 100_000)
            while (await page.receive()).type == aiohttp.WSMsgType.TEXT:
                pass
            return page.close_code

    assert talk(conversation) == aiohttp.WSCloseCode.MESSAGE_TOO_BIG


def test_end_is_quick_and_said_to_the_pages_alone(capfd):
    server = Server('127.0.0.1', 0, '', {}, lambda: 'hello')

    async def conversation(session):
        page = await live(session, server)
        silent = await live(session, server)
        await silent.receive_str()
        silent._response.connection.transport.pause_reading()  # it answers no farewell
        await page.receive_str()
        began = time.monotonic()
        ending = threading.Thread(target=server.close)
        ending.start()
        message = await page.receive()
        while ending.is_alive():
            await asyncio.sleep(0.005)
        return message.type, time.monotonic() - began

    kind, lasted = talk(conversation)
    assert kind == aiohttp.WSMsgType.CLOSE
    assert lasted < 1.0
    assert 'page' not in {thread.name for thread in threading.enumerate()}
    assert capfd.readouterr() == ('', '')


def test_address_is_one_that_a_browser_can_open():
    for host, begin in (
        ('::1', 'http://[::1]:'),
        ('0.0.0.0', f'http://{socket.gethostname()}:'),
        ('localhost', 'http://localhost:'),
    ):
        server = Server(host, 0, '', {}, str)
        try:
            assert server.address.startswith(begin)
            assert server.address.endswith('/')
        finally:
            server.close()
