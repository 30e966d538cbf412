# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Serves a page, and what is posted to it, to the browsers that show it.

The server has a thread of its own. A browser that is slow misses what was posted meanwhile: it gets
the newest of each kind, so nothing piles up.
"""

import asyncio
import ipaddress
import socket
import threading
from collections.abc import Awaitable, Callable, Mapping
from urllib.parse import urlsplit

from aiohttp import WSCloseCode, web

from tactile_push.watching.listening import listen

LIVE = '/live'  # where the page gets what is posted
MOST_PAGES = 20  # at the same time; picked
STALLED = 10.0  # a browser that takes nothing for so long is gone [s]; picked
HEARTBEAT = 10.0  # between questions whether a browser is still there [s]; picked
FAREWELL = 0.05  # for browsers to hear of the end [s]
REQUEST = 1024  # longest message from a page, which says nothing [byte]

Handler = Callable[[web.Request], Awaitable[web.StreamResponse]]


class Server:
    """Serves the page at `address`.

    `headers` go with the page. Each browser gets `hello()` first, which is called in the server's
    thread, and then the newest text of each kind that `post` was given.
    """

    def __init__(
        self, host: str, port: int, page: str, headers: Mapping[str, str], hello: Callable[[], str]
    ) -> None:
        listening = listen(host, port)
        self._page, self._headers, self._hello = page, headers, hello
        self._own_names = {'localhost', host.lower(), socket.gethostname().lower()}
        open_to_all = listening.getsockname()[0] in ('0.0.0.0', '::')
        place = socket.gethostname() if open_to_all else f'[{host}]' if ':' in host else host
        self.address = f'http://{place}:{listening.getsockname()[1]}/'
        self.pages = 0  # that are shown now
        self._posted: dict[str, str] = {}
        self._sockets: set[web.WebSocketResponse] = set()
        self._loop = asyncio.new_event_loop()
        self._closing, self._news = asyncio.Event(), asyncio.Event()
        self._thread = threading.Thread(
            target=self._run, args=(listening,), name='page', daemon=True
        )
        self._thread.start()

    def post(self, kind: str, text: str) -> None:
        """Send a text to all pages, in place of those of its kind that a page has not yet got."""
        self._loop.call_soon_threadsafe(self._take, kind, text)

    def close(self) -> None:
        """Say farewell to the pages and end."""
        self._loop.call_soon_threadsafe(self._closing.set)
        self._thread.join()

    def _run(self, listening: socket.socket) -> None:
        try:
            self._loop.run_until_complete(self._serve(listening))
        finally:
            self._loop.close()

    async def _serve(self, listening: socket.socket) -> None:
        app = web.Application(middlewares=[self._guard])
        app.add_routes([web.get('/', self._on_page), web.get(LIVE, self._on_live)])
        runner = web.AppRunner(app, access_log=None, shutdown_timeout=FAREWELL)
        await runner.setup()
        await web.SockSite(runner, listening).start()
        await self._closing.wait()
        farewells = [one.close(code=WSCloseCode.GOING_AWAY) for one in self._sockets]
        await asyncio.gather(*farewells, return_exceptions=True)
        await runner.cleanup()

    def _take(self, kind: str, text: str) -> None:
        self._posted[kind] = text
        self._news.set()
        self._news = asyncio.Event()

    @web.middleware
    async def _guard(self, request: web.Request, handler: Handler) -> web.StreamResponse:
        """Refuse pages of elsewhere whose name somebody lets lead here."""
        if not self._is_own(request.host):
            raise web.HTTPForbidden(text='expected the address of this machine\n')
        return await handler(request)

    def _is_own(self, place: str) -> bool:
        """Return whether a host with or without a port is a name of this machine, or a number."""
        try:
            name = urlsplit(f'//{place}').hostname or ''
        except ValueError:  # of brackets that hold no address
            return False
        try:
            ipaddress.ip_address(name)
        except ValueError:
            return bool({name, name.removesuffix('.local')} & self._own_names)
        return True  # nobody can let a number lead elsewhere

    async def _on_page(self, request: web.Request) -> web.Response:
        return web.Response(text=self._page, content_type='text/html', headers=self._headers)

    async def _on_live(self, request: web.Request) -> web.StreamResponse:
        if request.headers.get('Origin') != f'{request.scheme}://{request.host}':
            raise web.HTTPForbidden(text='expected the page of this server\n')
        if len(self._sockets) >= MOST_PAGES:
            raise web.HTTPServiceUnavailable(text=f'expected {MOST_PAGES} pages at the most\n')
        page = web.WebSocketResponse(
            timeout=FAREWELL, heartbeat=HEARTBEAT, compress=False, max_msg_size=REQUEST
        )
        await page.prepare(request)
        self._sockets.add(page)
        self.pages = len(self._sockets)
        sender = asyncio.create_task(self._send(page, request))
        try:
            async for _ in page:  # which has nothing to say but that it is there
                pass
        finally:
            self._sockets.discard(page)
            self.pages = len(self._sockets)
            sender.cancel()
            await asyncio.wait([sender])
        return page

    async def _send(self, page: web.WebSocketResponse, request: web.Request) -> None:
        """Send to one page as fast as it takes."""
        try:
            await asyncio.wait_for(page.send_str(self._hello()), STALLED)
            sent: dict[str, str] = {}
            while True:
                news = self._news
                waiting = [
                    kind for kind, text in self._posted.items() if sent.get(kind) is not text
                ]
                for kind in waiting:
                    text = self._posted[kind]
                    await asyncio.wait_for(page.send_str(text), STALLED)
                    sent[kind] = text
                if not waiting:
                    await news.wait()
        except (ConnectionError, asyncio.TimeoutError):
            if request.transport is not None:
                request.transport.abort()
